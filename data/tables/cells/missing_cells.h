#pragma once

#include <string_view>

namespace errmap::data {

/// True for "", NA, NaN, N/A, #N/A and NULL in any case: the cell holds
/// nothing.
bool IsMissingText(std::string_view text);

/// And for what else stands where a number is missing: "-", "?", "none",
/// "#DIV/0!", and what loggers write for no reading: OPEN, OL, OVER, ERR,
/// FAULT, NC, "---".
bool IsMissingNumber(std::string_view text);

}  // namespace errmap::data
