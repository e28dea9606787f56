#pragma once

#include "stats/eigen.h"
#include "stats/normality/ordered_sample.h"
#include "stats/test_result.h"

namespace errmap::stats {

/// Shapiro-Wilk test of normality by Royston's approximation (Applied
/// Statistics 44, 1995, algorithm AS R94), mean and sd estimated. The weights
/// are computed once for all samples of one size.
class ShapiroWilkTest {
 public:
  static constexpr Index kFewest = 3;
  static constexpr Index kMost = 5000;  // above it p is not calibrated

  explicit ShapiroWilkTest(Index n);

  /// Returns W and p of a sample of n values; not applicable unless 3 <= n <=
  /// 5000. Throws std::invalid_argument if `sample` has another size.
  TestResult operator()(const OrderedSample& sample) const;

 private:
  Index n_;
  VectorXd upper_weights_;  // (n/2) weights of x_(n), x_(n-1), ...
};

}  // namespace errmap::stats
