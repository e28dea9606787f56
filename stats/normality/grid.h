#pragma once

#include <optional>

#include <Eigen/Core>

namespace errmap::stats {

/// Steps of this many standard deviations over sqrt(n) move the tests of a
/// shape by less than their own scatter: rounding as fine is not looked for.
inline constexpr double kFinestStep = 0.1;

/// The step on which all of `ascending` (n >= 2, finite, standard deviation 1)
/// stand, as readings that were rounded do: the greatest common divisor of
/// their differences. Nothing where it is below kFinestStep / sqrt(n).
std::optional<double> FindStep(
    const Eigen::Ref<const Eigen::VectorXd>& ascending);

}  // namespace errmap::stats
