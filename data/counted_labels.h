#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::data {

/// Returns the text of a label without its numbers: "day run " for "day 1 run
/// 12".
std::string LessNumbers(std::string_view label);

/// Returns the session in each label of a list of cycles, in order. A label is
/// the session's with a number that counts the cycles within it: "day1" in
/// "day1_run2", "D1" in "D1C1", "X_20240304" in "X_20240304_01.rtl", "1" in
/// "1.1" or "101". Each session must be contiguous, and one must have two
/// labels or more. Returns nothing for other labels, or if there are fewer than
/// `least` sessions.
std::vector<std::string> SessionsOfCounted(
    const std::vector<std::string>& labels, std::size_t least = 2);

}  // namespace errmap::data
