#pragma once

#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "fitting/fold_codes.h"
#include "fitting/least_squares/regression_diagnostics.h"

namespace errmap::fitting {

enum class Penalty { kRidge, kLasso };

/// All solutions b(strength) of
///
///   min  sum w (y - b0 - X b)^2 / (2 sum w) + strength * P(b)
///
/// with P = |b|^2 / 2 (ridge: Hoerl and Kennard 1970) or the sum of |b_j|
/// (lasso: Tibshirani 1996), b being of columns scaled to (weighted) variance
/// 1. The intercept is not penalised; constant columns have coefficient 0.
class PenalizedPath {
 public:
  virtual ~PenalizedPath() = default;
  /// Coefficients (k) of the columns as given.
  virtual Eigen::VectorXd Coefficients(double strength) const = 0;
  /// Strength at and above which every coefficient is 0 (ridge: the largest
  /// squared singular value, which shrinks all by half or more).
  virtual double largest_strength() const = 0;
  /// The lowest strength that is worth while.
  virtual double smallest_strength() const = 0;
  /// Degrees of freedom, intercept included: the trace of the hat matrix
  /// (ridge), the number of terms (lasso: Zou, Hastie and Tibshirani 2007).
  virtual double DegreesOfFreedom(double strength) const = 0;
  virtual double Intercept(const Eigen::VectorXd& coefficients) const = 0;
};

/// Ridge by singular values, lasso by following its piecewise linear path knot
/// by knot (Osborne, Presnell and Turlach 2000): exact, with no iteration.
std::unique_ptr<PenalizedPath> MakePath(Penalty penalty,
                                        const RegressionProblem& problem);

struct PenalizedOptions {
  Penalty penalty = Penalty::kRidge;
  /// At least 0; NaN: by cross-validation.
  double strength = std::numeric_limits<double>::quiet_NaN();
  /// The strongest penalty within one standard error of the least error
  /// (Breiman et al. 1984) in place of the least error.
  bool one_standard_error = false;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

struct PenalizedFit {
  Eigen::VectorXd coefficients;  // (k)
  double intercept = 0.0;
  double strength = 0.0;
  double degrees_of_freedom = 0.0;
  double residual_sum_of_squares = 0.0;  // weighted
  // The cross-validation, falling strengths; empty where none was made.
  std::vector<double> strengths;
  std::vector<double> mean_squared_errors;
  std::vector<double> standard_errors;  // of those means, over folds (one: NaN)
};

/// Fits by `options`; `folds` (n rows) are needed where the strength is not
/// given. Every fold learns its own scaling. Throws
/// std::invalid_argument on bad shapes or options, or folds that are missing.
PenalizedFit FitPenalized(const RegressionProblem& problem,
                          const FoldCodes& folds,
                          const PenalizedOptions& options);

}  // namespace errmap::fitting
