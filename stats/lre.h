#pragma once

#include "stats/eigen.h"

namespace errmap::stats {

/// Digits to which NIST StRD sets are certified: 11 (nonlinear) and 15 (linear,
/// univariate).
inline constexpr double kLreCapNonlinear = 11.0;
inline constexpr double kLreCapLinear = 15.0;

/// Returns the number of digits in which `value` agrees with `certified`:
/// McCullough's log relative error (The American Statistician 52, 1998),
/// -log10(|x - c| / |c|), or -log10 |x - c| if c = 0. Clamped to [0, `cap`];
/// `cap` if equal, 0 if one is not finite. Throws std::invalid_argument unless
/// cap > 0.
double LogRelativeError(double value, double certified, double cap);

/// Returns the smallest LogRelativeError over the elements of two vectors.
/// Throws std::invalid_argument unless both have the same n >= 1.
double SmallestLogRelativeError(const Eigen::Ref<const VectorXd>& values,
                                const Eigen::Ref<const VectorXd>& certified,
                                double cap);

}  // namespace errmap::stats
