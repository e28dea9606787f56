#include <algorithm>
#include <cctype>
#include <vector>

#include "cli/shell/standard_streams.h"

namespace errmap::cli {
namespace {

// A part of a message with what stands before it.
struct Clause {
  std::string_view before;  // ", or ", "; ", or "" of the first
  std::string_view words;
};

std::string_view SeparatorAt(std::string_view text) {
  for (const std::string_view separator : {", or ", "; "}) {
    if (text.starts_with(separator)) return separator;
  }
  return "";
}

// An apostrophe within a word opens nothing.
bool OpensQuotation(std::string_view text, std::size_t at) {
  return (text[at] == '\'' || text[at] == '"') &&
         (at == 0 ||
          std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0);
}

// Returns the end of the quotation that begins there; `at` if it never ends.
std::size_t EndOfQuotation(std::string_view text, std::size_t at) {
  const std::size_t end = text.find(text[at], at + 1);
  return end == text.npos ? at : end;
}

std::vector<Clause> ClausesOf(std::string_view text) {
  std::vector<Clause> clauses{{"", {}}};
  std::size_t begin = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (OpensQuotation(text, at)) at = EndOfQuotation(text, at);
    const std::string_view separator = SeparatorAt(text.substr(at));
    if (separator.empty()) continue;
    clauses.back().words = text.substr(begin, at - begin);
    clauses.push_back({separator, {}});
    begin = at + separator.size();
    at = begin - 1;
  }
  clauses.back().words = text.substr(begin);
  return clauses;
}

bool AdvisesAnother(std::string_view words,
                    const std::function<bool(std::string_view)>& has) {
  if (words.find("errmap ") != words.npos) return false;
  for (std::size_t at = 0; at < words.size(); ++at) {
    if (OpensQuotation(words, at)) at = EndOfQuotation(words, at);
    const bool is_option =
        words.substr(at).starts_with("--") && (at == 0 || words[at - 1] == ' ');
    if (!is_option) continue;
    const std::size_t end = std::min(
        words.find_first_not_of("-abcdefghijklmnopqrstuvwxyz0123456789", at),
        words.size());
    if (end > at + 2 && !has(words.substr(at, end - at))) return true;
    at = end - 1;
  }
  return false;
}

}  // namespace

std::string WithOwnRemedies(
    std::string_view message,
    const std::function<bool(std::string_view option)>& has) {
  std::string kept;
  std::string_view before;  // of the first clause that was left out
  bool is_first = true;
  for (const Clause& clause : ClausesOf(message)) {
    if (!is_first && AdvisesAnother(clause.words, has)) {
      if (before.empty()) before = clause.before;
      continue;
    }
    kept += before.empty() ? clause.before : before;
    kept += clause.words;
    before = "";
    is_first = false;
  }
  return kept;
}

}  // namespace errmap::cli
