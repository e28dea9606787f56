#include "data/measurements/row_filters.h"

#include <algorithm>

#include "data/column_words.h"
#include "data/measurements/column_checks.h"
#include "data/text.h"
#include "data/way_words.h"

namespace errmap::data {
const ColumnFilter* DirectionFilter(std::span<const ColumnFilter> filters) {
  const auto found =
      std::ranges::find_if(filters, [](const ColumnFilter& filter) {
        const std::string word = ValueText(filter);
        // A tool may be number 1.
        const bool is_number = IsOneOf(word, "1 +1 -1");
        return Says(filter.column, Word::kDirection) ||
               (IsUpwards(word) && !is_number) ||
               IsOneOf(word, "forward reverse backward");
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
