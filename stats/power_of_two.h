#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Core>

namespace errmap::stats {

/// The power of two that brings the largest of `values` (n) to between 1 and 2
/// where they are divided by it, which is exact: squares of very large or small
/// values are lost. NaN where all are 0 or one is not finite.
inline double PowerOfTwoOf(const Eigen::Ref<const Eigen::VectorXd>& values) {
  const double size = values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0.0;
  return size > 0.0 && std::isfinite(size)
             ? std::scalbn(1.0, std::ilogb(size))
             : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace errmap::stats
