#pragma once

#include <Eigen/Core>

namespace errmap::stats {

/// Digits that certified values of the NIST StRD sets can confirm: they are
/// given to 11 digits (nonlinear) and to 15 (linear, univariate).
inline constexpr double kLreCapNonlinear = 11.0;
inline constexpr double kLreCapLinear = 15.0;

/// Agreeing digits of `value` with `certified`, McCullough's log relative error
/// (The American Statistician 52, 1998): -log10(|x - c| / |c|), with |x - c|
/// where c = 0; at most `cap`, which equal numbers get; 0 where negative or
/// either number is not finite. Throws std::invalid_argument unless cap > 0.
double LogRelativeError(double value, double certified, double cap);

/// Smallest LogRelativeError over the elements of two vectors (n >= 1). Throws
/// std::invalid_argument unless both have the same n >= 1.
double SmallestLogRelativeError(
    const Eigen::Ref<const Eigen::VectorXd>& values,
    const Eigen::Ref<const Eigen::VectorXd>& certified,
    double cap);

}  // namespace errmap::stats
