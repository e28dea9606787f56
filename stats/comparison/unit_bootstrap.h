#pragma once

#include <cstdint>
#include <limits>

#include <Eigen/Core>

#include "stats/comparison/unit_losses.h"

namespace errmap::stats {

/// How surely a figure is known, in its unit; NaN where no bound exists.
struct Bounds95 {
  // Two-sided 95 % interval: 2.5 % of risk on each side.
  double lower = std::numeric_limits<double>::quiet_NaN();
  double upper = std::numeric_limits<double>::quiet_NaN();
  // One-sided 95 % bounds: at least, at most.
  double at_least = std::numeric_limits<double>::quiet_NaN();
  double at_most = std::numeric_limits<double>::quiet_NaN();

  bool exist() const { return lower <= upper; }
  bool ExcludeZero() const { return lower > 0.0 || upper < 0.0; }
};

/// Bootstrap over units: they are drawn with replacement, each with all its
/// rows and the same for every model, and the RMSE pooled anew.
///
/// Each bound is the wider of two: Hesterberg's (2015, Section 5.3) expanded
/// percentile, and Student's t times the standard error by the delta method (of
/// the logarithm for one RMSE, which is skewed and above 0). A percentile never
/// goes beyond the worst single unit, so with 3 units a nominal 95 % of it is
/// 75 %; the t alone knows nothing of skewness. The coverage that results
/// stands in tests/stats/comparison/paired_comparison_null_test.cc.
class UnitBootstrap {
 public:
  /// Throws std::invalid_argument for resamples < 99 or invalid losses.
  UnitBootstrap(const UnitLosses& losses,
                Eigen::Index resamples,
                std::uint64_t seed);

  /// Bounds of the RMSE of `model`; none exist below 2 units. They are not
  /// within those of a mean square with the degrees of freedom that the units'
  /// own mean squares show (unit_freedom.h), times `worth`: of units that
  /// resemble their neighbours, the share that they count for.
  Bounds95 OfRmse(Eigen::Index model, double worth = 1.0) const;
  /// Bounds of RMSE of model `a` less that of `b`; none below 2 units.
  Bounds95 OfDifference(Eigen::Index a, Eigen::Index b) const;

 private:
  Eigen::Index units_;
  Eigen::VectorXd rmse_;       // (models)
  Eigen::MatrixXd influence_;  // (units x models) of each unit on the RMSE
  Eigen::MatrixXd resampled_;  // (resamples x models)
};

}  // namespace errmap::stats
