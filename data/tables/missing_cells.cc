#include "data/tables/missing_cells.h"

#include <algorithm>
#include <array>

#include "data/text.h"

namespace errmap::data {

bool IsMissingText(std::string_view text) {
  constexpr auto kWords = std::to_array<std::string_view>(
      {"", "na", "nan", "n/a", "#n/a", "#na", "#nv", "null", "(null)"});
  return std::ranges::any_of(kWords, [&](std::string_view word) {
    return EqualsIgnoringCase(text, word);
  });
}

bool IsMissingNumber(std::string_view text) {
  constexpr auto kWords = std::to_array<std::string_view>(
      {"?",        ".",         "none",      "nil",     "missing", "-nan",
       "nan(ind)", "-nan(ind)", "1.#qnan",   "-1.#ind", "1.#ind",  "#value!",
       "#div/0!",  "#num!",     "#ref!",     "#name?",  "#null!",  "open",
       "ol",       "-ol",       "+ol",       "o.l.",    "over",    "overload",
       "overflow", "overrange", "underflow", "err",     "fault",   "nc",
       "n.c.",     "no reading"});
  // A dash, or any number of them.
  return IsMissingText(text) ||
         text.find_first_not_of('-') == std::string_view::npos ||
         std::ranges::any_of(kWords, [&](std::string_view word) {
           return EqualsIgnoringCase(text, word);
         });
}

}  // namespace errmap::data
