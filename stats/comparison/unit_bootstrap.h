#pragma once

#include <cstdint>

#include "stats/comparison/unit_losses.h"
#include "stats/eigen.h"
#include "stats/not_a_number.h"

namespace errmap::stats {

/// 95 % bounds of a figure, in its unit; NaN if no bound exists.
struct Bounds95 {
  // Two-sided 95 % interval: 2.5 % of risk on each side.
  double lower = kNaN;
  double upper = kNaN;
  // One-sided 95 % bounds: at least, at most.
  double at_least = kNaN;
  double at_most = kNaN;

  bool exist() const { return lower <= upper; }
  bool ExcludeZero() const { return lower > 0.0 || upper < 0.0; }
  /// Upper one-sided bound of a - b (`is_first`) or of b - a, for a difference
  /// a - b.
  double ExcessAtMost(bool is_first) const {
    return is_first ? at_most : -at_least;
  }
};

/// Returns the wider of both at each end.
Bounds95 Wider(const Bounds95& one, const Bounds95& other);

/// Bootstrap over units. Units are drawn with replacement, each with all its
/// rows and the same for every model; the pooled RMSE is then recomputed.
///
/// Each bound is the wider of two. One is Hesterberg's (2015, Section 5.3)
/// expanded percentile, the other Student's t times the delta-method standard
/// error. For one RMSE, which is skewed and above 0, the latter applies to its
/// logarithm. A percentile never exceeds the worst single unit: with 3 units a
/// nominal 95 % covers 75 %. The t interval ignores skewness.
/// tests/stats/comparison/paired_comparison_null_test.cc measures the coverage.
class UnitBootstrap {
 public:
  /// Throws std::invalid_argument if resamples < 99 or `losses` are invalid.
  UnitBootstrap(const UnitLosses& losses, Index resamples, std::uint64_t seed);

  /// Returns bounds of the RMSE of `model`; NaN below 2 units. They are at
  /// least as wide as for a mean square with `worth` times the units' degrees
  /// of freedom (satterthwaite_dof.h). `worth` is effective units over units: 1
  /// unless neighbours resemble each other.
  Bounds95 OfRmse(Index model, double worth = 1.0) const;
  /// Returns bounds of RMSE(a) - RMSE(b); NaN below 2 units.
  Bounds95 OfDifference(Index a, Index b) const;

 private:
  Index units_;
  VectorXd rmse_;       // (models)
  MatrixXd influence_;  // (units x models) of each unit on the RMSE
  MatrixXd resampled_;  // (resamples x models)
};

}  // namespace errmap::stats
