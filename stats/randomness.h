#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "stats/test_result.h"

namespace errmap::stats {

/// Values in measured order, cut where neighbours are not to be compared: one
/// segment for the whole order, one per group for what happens within groups.
using Segments = std::vector<Eigen::VectorXd>;

/// One segment per group code, each in the order of `values` (n). Throws
/// std::invalid_argument unless there are n codes.
Segments SegmentsByGroup(const Eigen::Ref<const Eigen::VectorXd>& values,
                         const std::vector<Eigen::Index>& group_codes);

/// Is there memory in the order? All p are two-sided and assume, under the
/// null hypothesis, independent values of one distribution within a segment;
/// the serial tests also that it is normal.
struct SerialTests {
  /// Wald & Wolfowitz (1940) runs above and below the median of all values
  /// (those equal to it are passed over). statistic = (runs - expected) / sd
  /// given the counts; p exact where one segment has at most 10 values on
  /// one side, normal otherwise. Few runs: slow drifts.
  TestResult runs;
  Eigen::Index num_runs = 0;
  double expected_runs = 0.0;
  /// Autocorrelation at lag 1, sum d_i d_(i+1) / sum d_i^2 about each
  /// segment's own mean, and p of its normal score with the exact mean and
  /// variance for normal values (Moran 1948; Dufour & Roy 1985).
  TestResult lag1;
  double expected_lag1 = 0.0;  // below 0: the means were estimated
  /// Durbin & Watson's d = sum (d_(i+1) - d_i)^2 / sum d_i^2 about each
  /// segment's own mean; 2 without memory, below 2 with drifts. p of its normal
  /// score with von Neumann's (1941) variance, not by Durbin & Watson's bounds.
  TestResult durbin_watson;
  /// Ljung & Box (1978) over the first `num_lags` = min(10, n/5) lags (half
  /// the median length of several segments), p of chi-squared. With several
  /// segments: the sum of the squared scores of each lag's autocorrelation.
  TestResult ljung_box;
  Eigen::Index num_lags = 0;
};

/// Serial tests of `segments`. Each test says why where it does not apply:
/// too few values, all values equal, values that are not finite.
SerialTests TestSerially(const Segments& segments);

/// p of the same tests by shuffling: no distribution assumed, and exact but
/// for the draws, where the tests' own p are asymptotic (Ljung-Box rejects
/// 6.3 %, 5.9 % and 5.0 % of normal samples at a nominal 5 % for n = 30, 100
/// and 397).
struct SerialShuffles {
  Eigen::Index draws = 0;  // 0: not asked for
  double runs = 0.0;
  double lag1 = 0.0;
  double durbin_watson = 0.0;
  double ljung_box = 0.0;
};

/// p = (1 + #{shuffled at least as extreme}) / (draws + 1), each segment
/// shuffled within itself, seeded; extreme as the tests' own p is small. NaN
/// where a test does not apply. Throws std::invalid_argument for draws < 1.
SerialShuffles ShuffleSerially(const Segments& segments,
                               Eigen::Index draws,
                               std::uint64_t seed);

/// Are the first and the second half of the order from one distribution?
/// statistic = the two-sample K-S distance (two_sample_ks.h), p exact up to
/// kMostPairsForExactKs pairs, else asymptotic; assumes independent values.
/// n >= 4.
TestResult CompareHalves(const Eigen::Ref<const Eigen::VectorXd>& values);

}  // namespace errmap::stats
