#pragma once

#include <Eigen/Core>

namespace errmap::stats {

/// Are two samples from one distribution? (NISTIR 5367, section 8.)
struct TwoSampleKs {
  double d = 0.0;  // largest |F_a(x) - F_b(x)|
  /// P(D >= d) with every way of dealing the pooled values to the samples
  /// equally likely, ties kept as they are: exact. NaN where n m is above
  /// kMostPairsForExactKs.
  double p_exact = 0.0;
  double p_asymptotic = 0.0;  // Q(sqrt(n m / (n + m)) d), no ties
};

inline constexpr double kMostPairsForExactKs = 2e7;

/// Two-sample Kolmogorov-Smirnov test of `a` (n >= 1) and `b` (m >= 1), which
/// must be independent of each other and within themselves. The exact
/// probability counts lattice paths (Hodges 1957; with ties Schroeer &
/// Trenkler 1995), O(n m). Throws std::invalid_argument for an empty sample or
/// values that are not finite.
TwoSampleKs ComputeTwoSampleKs(const Eigen::Ref<const Eigen::VectorXd>& a,
                               const Eigen::Ref<const Eigen::VectorXd>& b);

}  // namespace errmap::stats
