#pragma once

#include <cmath>

#include "stats/eigen.h"
#include "stats/not_a_number.h"

namespace errmap::stats {

/// Returns a power of two that scales the largest of `values` (n) into [1, 2).
/// Dividing by it is exact, and then no square overflows or underflows. NaN if
/// all are 0 or one is not finite.
inline double PowerOfTwoOf(const Eigen::Ref<const VectorXd>& values) {
  const double size = values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0.0;
  return size > 0.0 && std::isfinite(size) ? std::scalbn(1.0, std::ilogb(size))
                                           : kNaN;
}

}  // namespace errmap::stats
