#include "data/formula_text.h"

#include <cstddef>

#include "data/text.h"

namespace errmap::data {
namespace {

constexpr char kApostrophe = '\'';

bool BeginsFormula(std::string_view text) {
  return !text.empty() &&
         std::string_view("=+-@").find(text[0]) != std::string_view::npos;
}

std::string_view AfterApostrophes(std::string_view text) {
  while (text.starts_with(kApostrophe)) text.remove_prefix(1);
  return text;
}

}  // namespace

bool NeedsApostrophe(std::string_view text) {
  double ignored = 0.0;
  return text.size() > 1 && BeginsFormula(AfterApostrophes(text)) &&
         !ParseNumber(text, &ignored);
}

std::string_view WithoutApostrophe(std::string_view text) {
  if (text.starts_with(kApostrophe) && BeginsFormula(AfterApostrophes(text))) {
    text.remove_prefix(1);
  }
  return text;
}

std::string MarkedCsv(std::string text) {
  bool is_cell_begin = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_cell_begin && text[i] == kApostrophe &&
        BeginsFormula(AfterApostrophes(std::string_view(text).substr(i)))) {
      return std::string(kFormulaMark) + "\n" + text;
    }
    // Within quotes too: a mark that was not needed does no harm.
    is_cell_begin =
        text[i] == ',' || text[i] == '\n' || (is_cell_begin && text[i] == '"');
  }
  return text;
}

}  // namespace errmap::data
