#pragma once

#include <vector>

#include "stats/eigen.h"

namespace errmap::models {

/// Times are sums of steps: what is due to so small a share of it is due.
inline constexpr double kTimeRounding = 1e-9;

/// Goes through `count` rows of a session in order of time, as a machine does
/// whose zero is set anew now and then. The first row is a zero. Every other is
/// judged by the zero before it: visit(row, zero); then it is one itself where
/// is_due(row, zero). Returns the zeros, ascending.
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
