#pragma once

#include <vector>

#include "stats/eigen.h"

namespace errmap::models {

/// Tolerance of a due time, as a share: times are sums of steps, with rounding
/// errors.
inline constexpr double kTimeRounding = 1e-9;

/// Goes through `count` rows of a session in order of time, as on a machine
/// that is re-zeroed now and then. The first row is a zero. Every other row
/// uses the last zero: visit(row, zero). It then becomes a zero if is_due(row,
/// zero). Returns the zeros, ascending.
template <typename IsDue, typename Visit>
std::vector<Index> ForZeros(Index count,
                            const IsDue& is_due,
                            const Visit& visit) {
  std::vector<Index> zeros;
  for (Index row = 0; row < count; ++row) {
    if (!zeros.empty()) visit(row, zeros.back());
    if (zeros.empty() || is_due(row, zeros.back())) zeros.push_back(row);
  }
  return zeros;
}

}  // namespace errmap::models
