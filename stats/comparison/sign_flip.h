#pragma once

#include <cstdint>
#include <vector>

#include "stats/eigen.h"
#include "stats/test_result.h"

namespace errmap::stats {

/// Tests whether the mean of paired differences is 0. Under the null hypothesis
/// each difference is equally likely with either sign. Units may have unequal
/// variances but must be independent.
struct SignFlipTest {
  /// statistic = the mean difference. p is two-sided: the share of sign
  /// patterns whose |mean| is at least as large; 1 if all differences are 0.
  TestResult test;
  bool exact = false;  // true: all patterns counted; false: drawn
  /// Smallest p possible: 2 / 2^m if exact, with m nonzero differences; 1 /
  /// (draws + 1) if drawn.
  double smallest_p = 1.0;
};

/// Tests each column of `differences` (units x pairs) with the same sign
/// patterns. Exact for at most kMostForExactFlips nonzero differences, by
/// merging the sums of two halves (Horowitz & Sahni 1974). Otherwise p = (1 +
/// #{as extreme}) / (draws + 1) from seeded draws. Throws std::invalid_argument
/// if draws < 1 or a difference is not finite.
std::vector<SignFlipTest> TestBySignFlips(const MatrixXd& differences,
                                          Index draws,
                                          std::uint64_t seed);

/// With more differences, summing all patterns takes longer than 10 000 draws.
inline constexpr Index kMostForExactFlips = 24;

}  // namespace errmap::stats
