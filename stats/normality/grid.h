#pragma once

#include <optional>

#include "stats/eigen.h"

namespace errmap::stats {

/// Smallest rounding step that is looked for, in standard deviations over
/// sqrt(n). Finer steps move the shape tests by less than their own scatter.
inline constexpr double kFinestStep = 0.1;

/// Returns the rounding step of `ascending` (n >= 2, finite, standard deviation
/// 1): the greatest common divisor of their differences. Returns nothing if it
/// is below kFinestStep / sqrt(n).
std::optional<double> FindStep(const Eigen::Ref<const VectorXd>& ascending);

}  // namespace errmap::stats
