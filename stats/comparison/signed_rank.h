#pragma once

#include "stats/eigen.h"
#include "stats/test_result.h"

namespace errmap::stats {

/// Wilcoxon's (1945) signed-rank test of whether paired differences are
/// symmetric about 0, with the defaults of R's wilcox.test.
struct SignedRankTest {
  /// statistic = V, the sum of the ranks of the positive differences. p is
  /// two-sided. Differences of 0 are dropped; p = 1 if none remain.
  TestResult test;
  /// True if p is from the distribution of V itself: below 50 differences, no
  /// ties, no zeros. Else p is normal, with continuity and tie corrections.
  bool exact = false;
};

/// Tests finite `differences`; needs at least one.
SignedRankTest TestSignedRanks(const Eigen::Ref<const VectorXd>& differences);

}  // namespace errmap::stats
