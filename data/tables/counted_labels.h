#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace errmap::data {

/// What a label is besides the numbers in it: "day  run " of "day 1 run 12".
std::string LessNumbers(std::string_view label);

/// Of labels that each end in a number, which counts on and begins anew under
/// another prefix, the prefix: "day1", "day1", "day2" of "day1_run1",
/// "day1_run2", "day2_run1". The prefixes differ in their numbers alone, and
/// each stands in one piece. Nothing of other labels.
std::vector<std::string> PrefixesOfCounted(
    const std::vector<std::string>& labels);

}  // namespace errmap::data
