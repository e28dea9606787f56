#include "data/measurements/row_filters.h"

#include <algorithm>

#include "data/measurements/column_checks.h"
#include "data/measurements/reading/column_words.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Words = std::initializer_list<std::string_view>;

bool IsOneOf(std::string_view word, Words words) {
  return std::ranges::any_of(words, [word](std::string_view of) {
    return EqualsIgnoringCase(word, of);
  });
}

}  // namespace

std::optional<bool> IsUpwards(std::string_view word) {
  if (IsOneOf(
          word,
          {"up", "+", "1", "+1", "pos", "positive", "plus", "increasing"})) {
    return true;
  }
  if (IsOneOf(word,
              {"down", "-", "-1", "neg", "negative", "minus", "decreasing"})) {
    return false;
  }
  return std::nullopt;
}

const ColumnFilter* DirectionFilter(std::span<const ColumnFilter> filters) {
  const auto found =
      std::ranges::find_if(filters, [](const ColumnFilter& filter) {
        const std::string word = ValueText(filter);
        // A tool may be number 1.
        const bool is_number = IsOneOf(word, {"1", "+1", "-1"});
        return Says(filter.column, Word::kDirection) ||
               (IsUpwards(word) && !is_number) ||
               IsOneOf(word, {"forward", "reverse", "backward"});
      });
  return found == filters.end() ? nullptr : &*found;
}

std::string FiltersText(std::span<const ColumnFilter> filters) {
  std::string text;
  for (const ColumnFilter& filter : filters) {
    text += (text.empty() ? "" : " and ") + NameInRemark(filter.column) + " " +
            NameInRemark(ValueText(filter));
  }
  return text;
}

}  // namespace errmap::data
