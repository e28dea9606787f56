#pragma once

#include <cstdint>
#include <vector>

#include "stats/eigen.h"
#include "stats/test_result.h"

namespace errmap::stats {

/// Values in order of measurement, cut where neighbours must not be compared.
/// There is one segment for all values, or one for each group.
using Segments = std::vector<VectorXd>;

/// Returns one segment per group code, each in the order of `values` (n).
/// Throws std::invalid_argument unless there are n codes.
Segments SegmentsByGroup(const Eigen::Ref<const VectorXd>& values,
                         const std::vector<Index>& group_codes);

/// Tests of whether the order of the values shows memory. All p are two-sided.
/// The null hypothesis is independent values of one distribution within a
/// segment; the serial tests also assume that it is normal.
struct SerialTests {
  /// Wald & Wolfowitz (1940) runs above and below the median of all values;
  /// values equal to it are skipped. The statistic is (runs - expected) / sd
  /// given the counts. p is exact if one segment has at most 10 values on one
  /// side, else normal. Few runs indicate slow drifts.
  TestResult runs;
  Index num_runs = 0;
  double expected_runs = 0.0;
  /// Autocorrelation at lag 1, sum d_i d_(i+1) / sum d_i^2 about each segment's
  /// own mean. p is that of its normal score, with the exact mean and variance
  /// for normal values (Moran 1948; Dufour & Roy 1985).
  TestResult lag1;
  double expected_lag1 = 0.0;  // below 0, since the means are estimated
  /// Durbin & Watson's d = sum (d_(i+1) - d_i)^2 / sum d_i^2 about each
  /// segment's own mean. It is 2 without memory, below 2 with drifts. p is from
  /// its normal score with von Neumann's (1941) variance, not Durbin & Watson's
  /// bounds.
  TestResult durbin_watson;
  /// Ljung & Box (1978) over the first `num_lags` = min(10, n/5) lags (half the
  /// median length of several segments); p from chi-squared. For several
  /// segments: the sum of the squared scores of each lag's autocorrelation.
  TestResult ljung_box;
  Index num_lags = 0;
};

/// Runs the serial tests on `segments`. A test that does not apply says why:
/// too few values, all values equal, or values that are not finite.
SerialTests TestSerially(const Segments& segments);

/// p of the same tests by shuffling. This assumes no distribution, and p is
/// exact apart from the random draws. The tests' own p are asymptotic: at a
/// nominal 5 % Ljung-Box rejects 6.3 %, 5.9 % and 5.0 % of normal samples for n
/// = 30, 100 and 397.
struct SerialShuffles {
  Index draws = 0;  // 0: not shuffled
  double runs = 0.0;
  double lag1 = 0.0;
  double durbin_watson = 0.0;
  double ljung_box = 0.0;
};

/// Returns p = (1 + #{shuffled at least as extreme}) / (draws + 1). Each
/// segment is shuffled within itself, from the seed. More extreme means a
/// smaller p of the test. Returns NaN if a test does not apply. Throws
/// std::invalid_argument if draws < 1.
SerialShuffles ShuffleSerially(const Segments& segments,
                               Index draws,
                               std::uint64_t seed);

/// Tests whether both halves of the order are from one distribution, by the
/// two-sample K-S distance (two_sample_ks.h). p is exact up to
/// kMostPairsForExactKs pairs, else asymptotic; it assumes independent values.
/// Needs n >= 4.
TestResult CompareHalves(const Eigen::Ref<const VectorXd>& values);

}  // namespace errmap::stats
