#pragma once

#include <string_view>

namespace errmap::data {

/// True for "", NA, NaN, N/A, #N/A and NULL in any case: the cell is empty.
bool IsMissingText(std::string_view text);

/// True also for other entries in place of a number: "-", "?", "none",
/// "#DIV/0!", and loggers' words for a missing reading: OPEN, OL, OVER, ERR,
/// FAULT, NC, "---".
bool IsMissingNumber(std::string_view text);

}  // namespace errmap::data
