#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

namespace errmap::stats {

/// Returns the value at `rank` (0: the smallest) of `values`, a std::vector or
/// an Eigen vector in any order. rank < values.size(); no NaN.
template <typename Values>
auto OrderStatistic(Values values, std::size_t rank) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// The median; for an even number of values, the upper of the middle two. So it
/// is always one of the values. At least one value, no NaN.
template <typename Values>
auto UpperMedian(Values values) {
  const auto middle = static_cast<std::size_t>(values.size()) / 2;
  return OrderStatistic(std::move(values), middle);
}

}  // namespace errmap::stats
