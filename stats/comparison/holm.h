#pragma once

#include <vector>

namespace errmap::stats {

/// Holm's (1979) step-down adjustment: p of each test such that the chance of
/// any false rejection among all of them is at most the level. NaN entries stay
/// NaN and do not count.
std::vector<double> AdjustByHolm(const std::vector<double>& p);

}  // namespace errmap::stats
