#include "data/measurements/row_filters.h"

#include <algorithm>

#include "data/column_words.h"
#include "data/measurements/column_checks.h"
#include "data/text.h"

namespace errmap::data {
namespace {

// Of the position, and of a way that may go up or down.
constexpr std::string_view kUp =
    "up + 1 +1 pos positive positiv plus increasing auf >";
constexpr std::string_view kDown =
    "down dn - -1 neg negative negativ minus decreasing ab <";
constexpr std::string_view kForth =
    "forward forwards fwd f vor vorw\u00e4rts hin aller avanti andata ida "
    "zheng";
constexpr std::string_view kBack =
    "reverse rev r backward backwards bwd b r\u00fcck zur\u00fcck "
    "r\u00fcckw\u00e4rts her retour indietro ritorno vuelta fan";

}  // namespace

std::optional<bool> IsUpwards(std::string_view word) {
  if (IsOneOf(word, kUp) || IsOneOf(word, kForth)) return true;
  if (IsOneOf(word, kDown) || IsOneOf(word, kBack)) return false;
  return std::nullopt;
}

std::optional<bool> FirstIsUp(std::string_view first, std::string_view second) {
  if (IsOneOf(first, kUp) && IsOneOf(second, kDown)) return true;
  if (IsOneOf(first, kDown) && IsOneOf(second, kUp)) return false;
  return std::nullopt;
}

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
