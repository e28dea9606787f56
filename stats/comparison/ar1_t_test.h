#pragma once

#include "stats/comparison/unit_bootstrap.h"
#include "stats/comparison/unit_losses.h"
#include "stats/eigen.h"
#include "stats/not_a_number.h"
#include "stats/test_result.h"

namespace errmap::stats {

/// Margins for MemoryOf: the number of standard errors added to the estimated
/// memory (lag-1 correlation) from unit to unit.
inline constexpr double kLikelyMemory = 0.4;
inline constexpr double kMostMemory = 1.6448536269514722;  // a 95 % bound

/// Returns the correlation of neighbours in `series` (n >= 4, in order), from 0
/// to 0.98. It is the lag-1 correlation r, corrected for bias (Marriott & Pope
/// 1954: E r = rho - (1 + 3 rho) / n), plus `margin` standard errors. 0 if the
/// series does not vary.
double MemoryOf(const Eigen::Ref<const VectorXd>& series, double margin);

/// Memory assumed between sessions that are known to be separate. So few
/// sessions cannot show their memory, and with its upper bound ten sessions
/// would never prove anything.
inline constexpr double kSessionMemory = 0.5;
/// The same for a PointOptimalTest: with 0.5, its error rate at that memory
/// would be just 5 %.
inline constexpr double kSessionMemoryInTurn = 0.55;

/// ShownMemory returns MemoryOf with kLikelyMemory if the estimate is more than
/// `above` standard errors above 0, else 0. With kShows, a fifth of series
/// without memory seem to have some. Of series with memory 0.3, one in six of
/// 40 values and one in three of 20 seem to have none. kSuspected misses strong
/// memory less often. Effect on a test:
/// tests/stats/comparison/paired_comparison_null_test.cc.
inline constexpr double kShows = 0.9;
inline constexpr double kSuspected = 0.6;
double ShownMemory(const Eigen::Ref<const VectorXd>& series,
                   double above = kShows);

/// Returns the number of independent units that would give an equally precise
/// mean: n (1 - memory) / (1 + memory), at least 2.
double EffectiveUnits(Index units, double memory);

/// Distribution of the mean of n normal values that follow a first-order
/// autoregression with coefficient `memory`. Divided by s / sqrt(n), the mean
/// is Student's t times `inflation`. Correlation makes s^2 too small on
/// average, and it varies like a chi-squared of fewer degrees of freedom (by
/// its first two moments: Box 1954; Satterthwaite 1946).
struct MeanWithMemory {
  double inflation = 1.0;
  double degrees_of_freedom = 0.0;
};
/// Returns this distribution for at least 2 units and a memory of 0 to 0.98.
MeanWithMemory OfMean(Index units, double memory);

/// Test of a difference of pooled RMSE, for a given memory from unit to unit.
struct MemoryTest {
  TestResult test;  // statistic = t, two-sided
  Bounds95 bounds;  // of the difference
  double memory = kNaN;
  double degrees_of_freedom = kNaN;
};

/// Tests all pairs of models on the same units, which are in order.
///
/// To first order the difference is the mean of the units' contributions, with
/// the distribution that OfMean gives. In a dozen units, the estimated memory
/// would miss half of all memory; its upper bound does not. Simulated error
/// rates are in tests/models/study/confidence_null_test.cc.
class Ar1TTest {
 public:
  /// Throws std::invalid_argument if `losses` are invalid.
  explicit Ar1TTest(const UnitLosses& losses);

  /// Tests the RMSE of model `a` minus that of `b`, given `memory` (0 to 0.98).
  /// Not applicable below 4 units.
  MemoryTest OfDifference(Index a, Index b, double memory) const;
  /// Return MemoryOf and ShownMemory of the units' contributions to that
  /// difference; 0 below 4 units.
  double InDifference(Index a, Index b, double margin) const;
  double ShownInDifference(Index a, Index b) const;
  /// Returns effective units over units for the model's RMSE: below 1 if the
  /// losses within units (about their means, if known) show memory, by
  /// kSuspected. These are a share of the scatter of all losses. 1 below 20
  /// units, where losses seem to have memory as often without it as with it.
  double Worth(Index model) const;

 private:
  VectorXd rmse_;       // (models)
  MatrixXd influence_;  // (units x models)
  MatrixXd within_;     // (units x models) mean squares
};

}  // namespace errmap::stats
