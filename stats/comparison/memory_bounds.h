#pragma once

#include <limits>

#include <Eigen/Core>

#include "stats/comparison/unit_bootstrap.h"
#include "stats/comparison/unit_losses.h"
#include "stats/test_result.h"

namespace errmap::stats {

/// A difference of pooled RMSE, judged with as much memory from unit to unit as
/// the units' order cannot exclude.
struct MemoryTest {
  TestResult test;  // statistic = t, two-sided
  Bounds95 bounds;  // of the difference
  /// Upper 95 % bound of the correlation of neighbours; 0 to 0.98.
  double memory = std::numeric_limits<double>::quiet_NaN();
  /// Independent units that are worth as much: n (1 - memory) / (1 + memory),
  /// at least 2; degrees of freedom are one less.
  double effective_units = std::numeric_limits<double>::quiet_NaN();
};

/// Tests of all pairs of models on the same units, which stand in order.
///
/// To first order the difference is the mean of what each unit adds to it. With
/// the lag-1 correlation r of these n values, freed of its bias (Marriott &
/// Pope 1954: E r = rho - (1 + 3 rho) / n), a first-order autoregression of
/// the coefficient memory = rho + 1.645 sqrt((1 - rho^2) / n) gives the
/// standard error of the mean; t as of effective_units. The estimate of rho
/// alone would miss half of all memory in a dozen units, its upper bound does
/// not. What it is worth stands in tests/models/study/confidence_null_test.cc.
class MemoryBounds {
 public:
  /// Throws std::invalid_argument for invalid losses.
  explicit MemoryBounds(const UnitLosses& losses);

  /// RMSE of model `a` less that of `b`; does not apply below 4 units.
  MemoryTest OfDifference(Eigen::Index a, Eigen::Index b) const;

 private:
  Eigen::VectorXd rmse_;       // (models)
  Eigen::MatrixXd influence_;  // (units x models)
};

}  // namespace errmap::stats
