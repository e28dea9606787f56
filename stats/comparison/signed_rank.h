#pragma once

#include <Eigen/Core>

#include "stats/test_result.h"

namespace errmap::stats {

/// Wilcoxon's (1945) signed-rank test: are paired differences symmetric about
/// 0? As R's wilcox.test with its defaults.
struct SignedRankTest {
  /// statistic = V, the sum of the ranks of the positive differences; p
  /// two-sided. Differences of 0 are dropped; 1 where nothing is left.
  TestResult test;
  /// From the distribution of V itself: below 50 differences without ties and
  /// zeros. Else normal, with corrections for continuity and ties.
  bool exact = false;
};

/// Tests finite `differences`; needs at least one.
SignedRankTest TestSignedRanks(
    const Eigen::Ref<const Eigen::VectorXd>& differences);

}  // namespace errmap::stats
