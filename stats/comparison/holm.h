#pragma once

#include <vector>

namespace errmap::stats {

/// Returns the p values adjusted by Holm's (1979) step-down method. It limits
/// the chance of any false rejection among all tests to the level. NaN entries
/// stay NaN and are not counted.
std::vector<double> AdjustByHolm(const std::vector<double>& p);

}  // namespace errmap::stats
