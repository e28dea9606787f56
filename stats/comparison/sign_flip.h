#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "stats/test_result.h"

namespace errmap::stats {

/// Is the mean of paired differences 0? Under the null hypothesis each
/// difference is as likely with the other sign, whatever its size: the units
/// may vary unequally, but must be independent.
struct SignFlipTest {
  /// statistic = the mean difference; p two-sided, the share of sign patterns
  /// whose |mean| is at least as large. 1 where all differences are 0.
  TestResult test;
  bool exact = false;  // all patterns counted, else drawn
  /// What p cannot fall below: 2 / 2^m exactly, m differences other than 0;
  /// 1 / (draws + 1) where drawn.
  double smallest_p = 1.0;
};

/// Tests each column of `differences` (units x pairs), all by the same sign
/// patterns. Exact for at most kMostForExactFlips differences other than 0,
/// by a merge of the sums of two halves (Horowitz & Sahni 1974); otherwise
/// p = (1 + #{as extreme}) / (draws + 1) of seeded draws. Throws
/// std::invalid_argument for draws < 1 or a difference that is not finite.
std::vector<SignFlipTest> TestBySignFlips(const Eigen::MatrixXd& differences,
                                          Eigen::Index draws,
                                          std::uint64_t seed);

/// Above this the sums of all patterns take longer than 10 000 draws.
inline constexpr Eigen::Index kMostForExactFlips = 24;

}  // namespace errmap::stats
