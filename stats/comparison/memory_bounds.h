#pragma once

#include <limits>

#include <Eigen/Core>

#include "stats/comparison/unit_bootstrap.h"
#include "stats/comparison/unit_losses.h"
#include "stats/test_result.h"

namespace errmap::stats {

/// By how many of its standard errors the memory from unit to unit is taken
/// above its estimate.
inline constexpr double kLikelyMemory = 0.4;
inline constexpr double kMostMemory = 1.6448536269514722;  // a 95 % bound

/// Correlation of neighbours in `series` (n >= 4, in order): the lag-1
/// correlation r, freed of its bias (Marriott & Pope 1954: E r = rho - (1 + 3
/// rho) / n), and `margin` standard errors more; 0 to 0.98. 0 where the series
/// does not vary.
double MemoryOf(const Eigen::Ref<const Eigen::VectorXd>& series, double margin);

/// What neighbouring sessions may share that are known to be separate: they
/// count for half. So few cannot tell, and an upper bound of what they show
/// would prove nothing of ten sessions.
inline constexpr double kSessionMemory = 1.0 / 3.0;

/// MemoryOf with kLikelyMemory where the estimate alone is above so many
/// standard errors of no memory, else 0: what a series shows. By the first a
/// fifth of series without memory seem to have some, of 40 and 20 values with
/// memory 0.3 one in six and three seem to have none
/// (tests/stats/comparison/paired_comparison_null_test.cc: what that leaves of
/// a test). The second misses strong memory in fewer cases.
inline constexpr double kShows = 0.9;
inline constexpr double kSuspected = 0.6;
double ShownMemory(const Eigen::Ref<const Eigen::VectorXd>& series,
                   double above = kShows);

/// So many independent units are worth as much for a mean: n (1 - memory) / (1
/// + memory), at least 2.
double EffectiveUnits(Eigen::Index units, double memory);

/// A difference of pooled RMSE, judged with some memory from unit to unit.
struct MemoryTest {
  TestResult test;  // statistic = t, two-sided
  Bounds95 bounds;  // of the difference
  double memory = std::numeric_limits<double>::quiet_NaN();
  double effective_units = std::numeric_limits<double>::quiet_NaN();
};

/// Tests of all pairs of models on the same units, which stand in order.
///
/// To first order the difference is the mean of what each unit adds to it. A
/// first-order autoregression of these n values gives the standard error of the
/// mean; t with one degree of freedom less than there are effective units. The
/// estimate of the memory alone would miss half of all memory in a dozen units,
/// its upper bound does not. What that is worth stands in
/// tests/models/study/confidence_null_test.cc.
class MemoryBounds {
 public:
  /// Throws std::invalid_argument for invalid losses.
  explicit MemoryBounds(const UnitLosses& losses);

  /// RMSE of model `a` less that of `b` with so much `memory` (0 to 0.98); does
  /// not apply below 4 units.
  MemoryTest OfDifference(Eigen::Index a, Eigen::Index b, double memory) const;
  /// MemoryOf what the units add to that difference, and ShownMemory; 0 below 4
  /// units.
  double InDifference(Eigen::Index a, Eigen::Index b, double margin) const;
  double ShownInDifference(Eigen::Index a, Eigen::Index b) const;
  /// What the mean errors of a model show, where they are known; else, and from
  /// 20 units on if it is more, what its losses show, by kSuspected. 0 below 4
  /// units.
  double ShownInLosses(Eigen::Index model) const;

 private:
  Eigen::VectorXd rmse_;       // (models)
  Eigen::MatrixXd influence_;  // (units x models)
  Eigen::MatrixXd means_;      // (units x models), or empty
};

}  // namespace errmap::stats
