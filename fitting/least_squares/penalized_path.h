#pragma once

#include <string_view>
#include <vector>

#include "fitting/least_squares/cross_products.h"
#include "stats/eigen.h"

namespace errmap::fitting {

enum class Penalty { kRidge, kLasso };
std::string_view ToString(Penalty penalty);  // "ridge", "lasso"

/// Solutions of
///
///   min  sum w (y - b0 - X b)^2 / (2 sum w) + strength * P(b)
///
/// with P = |b|^2 / 2 (ridge: Hoerl and Kennard 1970) or the sum of |b_j|
/// (lasso: Tibshirani 1996), from cross-products. b applies to columns scaled
/// to (weighted) variance 1. The intercept is not penalised; constant columns
/// have coefficient 0. Without an intercept, columns are scaled to mean square
/// 1 and b0 = 0.
class PenalizedPath {
 public:
  PenalizedPath(Penalty penalty, const CrossProducts& sums, bool intercept);
  /// A ridge with fewer rows than columns, solved in the space of the rows (n x
  /// n). `sums` are those of `columns` (n x k), `response` (n) and `weights`
  /// (n), (0): all 1.
  PenalizedPath(const CrossProducts& sums,
                bool intercept,
                const MatrixXd& columns,
                const VectorXd& response,
                const VectorXd& weights);

  /// Returns a descending grid of useful strengths. Ridge: from 10 times a
  /// column's variance down to the onset of rounding. Lasso: from the strength
  /// at which all coefficients are 0 down to a share of it.
  std::vector<double> Grid() const;

  struct Solutions {
    MatrixXd coefficients;  // (k x strengths) for the columns as given
    VectorXd intercepts;    // (strengths)
  };
  /// Returns solutions for `strengths`, at least 0, in any order. If columns
  /// depend on each other, a ridge at 0 has the limit of weak strengths. Ridge
  /// uses Cholesky factors. The lasso follows its piecewise linear path knot by
  /// knot (Osborne, Presnell and Turlach 2000). Each solution is then checked
  /// against the conditions of a minimum: x_j'r = strength sign(b_j) if b_j is
  /// not 0, else |x_j'r| <= strength, to 1e-13 of the largest correlation and
  /// the rounding of the sums. An active-set method corrects it if it violates
  /// them.
  Solutions Solve(const std::vector<double>& strengths) const;

  /// Takes one step of iterative refinement of a ridge solution for `strength`
  /// > 0. The residuals e enter as the sums of w e and, (k), of w e x. Normal
  /// equations lose twice the digits that nearly dependent columns cost; this
  /// recovers half (Björck 1996, 2.9.3). Does nothing if the matrix is not
  /// positive definite at this strength.
  void Refine(double strength,
              double residuals,
              const VectorXd& with_columns,
              Solutions* solution) const;

  /// Returns the degrees of freedom with intercept: trace of the hat matrix
  /// (ridge), number of terms (lasso: Zou, Hastie and Tibshirani 2007).
  double DegreesOfFreedom(double strength, const VectorXd& coefficients) const;

 private:
  // Sets means, scales and the covariance with the response.
  void Standardise(const CrossProducts& sums);
  bool in_rows() const { return rows_.size() > 0; }
  // Lower triangle of the matrix to factorise: that of the columns, or of the
  // rows, plus strength I.
  MatrixXd Shifted(double strength) const;
  MatrixXd RidgeSolutions(const std::vector<double>& strengths) const;
  MatrixXd LassoSolutions(const std::vector<double>& strengths) const;

  Penalty penalty_;
  bool intercept_;
  double weight_;               // sum of w
  VectorXd means_;              // (k) 0 without an intercept
  VectorXd scales_;             // (k) 1 / spread; 0 for constant columns
  double mean_response_ = 0.0;  // 0 without an intercept
  // (k x k) of the scaled columns; for a ridge only the lower triangle.
  MatrixXd correlation_;
  VectorXd covariance_;  // (k) of the scaled columns and the response
  // In the space of the rows, where correlation_ is (n x n) of the rows.
  MatrixXd rows_;      // (n x k) scaled, times the root of the weight
  VectorXd response_;  // (n) minus its mean, times the same
};

}  // namespace errmap::fitting
