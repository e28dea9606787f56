#pragma once

#include <vector>

#include "stats/eigen.h"
#include "stats/test_result.h"

namespace errmap::stats {

/// Mean of the residuals at one position or in one group.
struct LevelBias {
  Index n = 0;
  double mean = 0.0;
  double standard_error = 0.0;  // own sd / sqrt(n); NaN for n < 2
};

/// Means per level, and a test of whether they differ by more than chance.
struct BiasByLevel {
  std::vector<LevelBias> levels;  // indexed by code; n = 0 for a code not used
  /// One-way analysis of variance: F = between / within mean squares. p assumes
  /// independent normal values of one sd. Needs at least 2 levels with values,
  /// and one level with at least 2 values.
  TestResult anova;
  /// Share of the sum of squares that the level means explain (eta squared).
  double explained = 0.0;  // NaN if the values do not vary
};

/// Returns the biases of `values` (n) by level. `codes` (n) are >= 0. Throws
/// std::invalid_argument unless there are n codes, none negative.
BiasByLevel ComputeBias(const Eigen::Ref<const VectorXd>& values,
                        const std::vector<Index>& codes);

/// Returns a code 0, 1 ... for each value of `at` (n), numbered by ascending
/// distinct value. `distinct` (may be null) receives the distinct values.
std::vector<Index> CodesOfValues(const Eigen::Ref<const VectorXd>& at,
                                 std::vector<double>* distinct);

/// Tests whether the variance of `residuals` (n) changes with `fitted` (n).
/// Breusch & Pagan (1979) in Koenker's (1981) studentised form: n R^2 of the
/// regression of e^2 on the fitted value. p is from chi-squared with 1 degree
/// of freedom. Assumes independent residuals, not normal ones. Needs n >= 4.
/// Throws std::invalid_argument if the sizes differ.
TestResult BreuschPagan(const Eigen::Ref<const VectorXd>& residuals,
                        const Eigen::Ref<const VectorXd>& fitted);

}  // namespace errmap::stats
