#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "fitting/least_squares/cross_products.h"

namespace errmap::fitting {

enum class Penalty { kRidge, kLasso };
std::string_view ToString(Penalty penalty);  // "ridge", "lasso"

/// Solutions of
///
///   min  sum w (y - b0 - X b)^2 / (2 sum w) + strength * P(b)
///
/// with P = |b|^2 / 2 (ridge: Hoerl and Kennard 1970) or the sum of |b_j|
/// (lasso: Tibshirani 1996), b being of columns scaled to (weighted) variance
/// 1, from cross-products. The intercept is not penalised; constant
/// columns have coefficient 0. Without an intercept columns are scaled to mean
/// square 1 in place of variance 1, and b0 = 0.
class PenalizedPath {
 public:
  PenalizedPath(Penalty penalty, const CrossProducts& sums, bool intercept);
  /// A ridge of fewer rows than columns, in the space of the rows (n x n),
  /// whose `sums` these are: `columns` (n x k), `response` (n), `weights` (n),
  /// or (0) where all are 1.
  PenalizedPath(const CrossProducts& sums,
                bool intercept,
                const Eigen::MatrixXd& columns,
                const Eigen::VectorXd& response,
                const Eigen::VectorXd& weights);

  /// Strengths worth trying, falling: for ridge from 10 times a column's
  /// variance down to where rounding begins, for the lasso from where every
  /// coefficient is 0 down to a share of it.
  std::vector<double> Grid() const;

  struct Solutions {
    Eigen::MatrixXd coefficients;  // (k x strengths) of the columns as given
    Eigen::VectorXd intercepts;    // (strengths)
  };
  /// Solutions for `strengths`, at least 0, in any order; a ridge needs more
  /// than 0 where columns depend on each other, and has the limit of a weak one
  /// there. Ridge by Cholesky factors. The lasso follows its piecewise linear
  /// path knot by knot (Osborne, Presnell and Turlach 2000); each answer is
  /// then held against the conditions of a minimum,
  ///   x_j'r = strength sign(b_j) where b_j is not 0, else |x_j'r| <= strength,
  /// to 1e-13 of the largest correlation and the rounding of the sums, and an
  /// active-set method mends it where it misses them.
  Solutions Solve(const std::vector<double>& strengths) const;

  /// One step of iterative refinement of a ridge's solution for `strength`,
  /// above 0, from what it leaves over: the sums of w e, and (k) of w e x, over
  /// the residuals e. Normal equations lose twice the digits that columns near
  /// dependence cost; this brings back the half (Björck 1996, 2.9.3). Leaves a
  /// solution as it is that a strength this weak did not make definite.
  void Refine(double strength,
              double residuals,
              const Eigen::VectorXd& with_columns,
              Solutions* solution) const;

  /// Of one solution, intercept included: the trace of the hat matrix (ridge),
  /// the number of terms (lasso: Zou, Hastie and Tibshirani 2007).
  double DegreesOfFreedom(double strength,
                          const Eigen::VectorXd& coefficients) const;

 private:
  // Means, scales and the covariance with the response.
  void Standardise(const CrossProducts& sums);
  bool in_rows() const { return rows_.size() > 0; }
  // What is factorised: a matrix of the columns, or of the rows, plus strength;
  // its lower triangle.
  Eigen::MatrixXd Shifted(double strength) const;
  Eigen::MatrixXd RidgeSolutions(const std::vector<double>& strengths) const;
  Eigen::MatrixXd LassoSolutions(const std::vector<double>& strengths) const;

  Penalty penalty_;
  bool intercept_;
  double weight_;               // sum of w
  Eigen::VectorXd means_;       // (k) 0 without an intercept
  Eigen::VectorXd scales_;      // (k) 1 / spread; 0 for constant columns
  double mean_response_ = 0.0;  // 0 without an intercept
  // (k x k) of the scaled columns; of a ridge the lower triangle alone.
  Eigen::MatrixXd correlation_;
  Eigen::VectorXd covariance_;  // (k) of the scaled columns and the response
  // In the space of the rows, where correlation_ is of them (n x n).
  Eigen::MatrixXd rows_;      // (n x k) scaled, by the root of their weight
  Eigen::VectorXd response_;  // (n) less its mean, likewise
};

}  // namespace errmap::fitting
