#pragma once

#include <vector>

#include <Eigen/Core>

namespace errmap::stats {

/// `most` of the places 0 .. count-1, rising, where there are more: one drawn
/// from each of so many equal stretches, the same at every call, of the outer
/// ones the first and the last place. Even steps would fall in step with
/// whatever recurs in the rows: of machine positions that repeat every 20 rows
/// each 20th is one position, and none of them is among each fifth that a
/// hold-out tests.
std::vector<Eigen::Index> SpreadSample(Eigen::Index count, Eigen::Index most);

/// What stands at these places of `all`.
std::vector<Eigen::Index> SpreadSample(const std::vector<Eigen::Index>& all,
                                       Eigen::Index most);

}  // namespace errmap::stats
