#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::data {

/// What a label is besides the numbers in it: "day  run " of "day 1 run 12".
std::string LessNumbers(std::string_view label);

/// Of labels of cycles, in order, the session that each names beside a number
/// that counts on and begins anew with each session: "day1" of "day1_run2",
/// "D1" of "D1C1", "X_20240304" of "X_20240304_01.rtl", "1" of "1.1" or "101".
/// Sessions stand in one piece, one of them with two labels or more. Nothing of
/// other labels, or where these are fewer sessions than `least`.
std::vector<std::string> SessionsOfCounted(
    const std::vector<std::string>& labels, std::size_t least = 2);

}  // namespace errmap::data
