#pragma once

#include <vector>

#include <Eigen/Core>

#include "stats/test_result.h"

namespace errmap::stats {

/// Mean of the residuals at one position or in one group.
struct LevelBias {
  Eigen::Index n = 0;
  double mean = 0.0;
  double standard_error = 0.0;  // own sd / sqrt(n); NaN for n < 2
};

/// Means per level and whether they differ by more than chance.
struct BiasByLevel {
  std::vector<LevelBias> levels;  // by code 0, 1, ...; n = 0 where unused
  /// One-way analysis of variance, F = between / within mean squares; p
  /// assumes independent normal values of one sd. Needs 2 levels in use, one
  /// of them with 2 values.
  TestResult anova;
  /// Share of the sum of squares that the level means explain (eta squared).
  double explained = 0.0;  // NaN where the values do not vary
};

/// Biases of `values` (n) by level; `codes` (n) are >= 0. Throws
/// std::invalid_argument unless there are n codes, none negative.
BiasByLevel ComputeBias(const Eigen::Ref<const Eigen::VectorXd>& values,
                        const std::vector<Eigen::Index>& codes);

/// Codes 0, 1 ... of the distinct values of `at` (n), ascending; `distinct`
/// gets them (may be null).
std::vector<Eigen::Index> CodesOfValues(
    const Eigen::Ref<const Eigen::VectorXd>& at, std::vector<double>* distinct);

/// Does the variance of `residuals` (n) change with `fitted` (n)? Breusch &
/// Pagan (1979) in Koenker's (1981) studentised form: n R^2 of the regression
/// of e^2 on the fitted value, p of chi-squared with 1 degree of freedom;
/// assumes independent residuals, not that they are normal. n >= 4. Throws
/// std::invalid_argument on sizes that do not agree.
TestResult BreuschPagan(const Eigen::Ref<const Eigen::VectorXd>& residuals,
                        const Eigen::Ref<const Eigen::VectorXd>& fitted);

}  // namespace errmap::stats
