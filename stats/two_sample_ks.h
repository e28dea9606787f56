#pragma once

#include "stats/eigen.h"

namespace errmap::stats {

/// Tests whether two samples are from one distribution (NISTIR 5367, section
/// 8).
struct TwoSampleKs {
  double d = 0.0;  // largest |F_a(x) - F_b(x)|
  /// Exact P(D >= d): every assignment of the pooled values to the two samples
  /// is equally likely, with ties kept. NaN if n m is above
  /// kMostPairsForExactKs.
  double p_exact = 0.0;
  double p_asymptotic = 0.0;  // Q(sqrt(n m / (n + m)) d), no ties
};

inline constexpr double kMostPairsForExactKs = 2e7;

/// Two-sample Kolmogorov-Smirnov test of `a` (n >= 1) and `b` (m >= 1), which
/// must be independent of each other and within themselves. The exact
/// probability counts lattice paths (Hodges 1957; with ties Schroeer & Trenkler
/// 1995) in O(n m). Throws std::invalid_argument if a sample is empty or a
/// value is not finite.
TwoSampleKs ComputeTwoSampleKs(const Eigen::Ref<const VectorXd>& a,
                               const Eigen::Ref<const VectorXd>& b);

}  // namespace errmap::stats
