#pragma once

#include <vector>

#include <Eigen/Core>

namespace errmap::fitting {

/// Solution of min |sqrt(weights) (y - X b)|.
struct LeastSquaresFit {
  Eigen::VectorXd coefficients;  // (p) 0 for aliased columns
  Eigen::Index rank = 0;
  std::vector<Eigen::Index> aliased;     // columns that the others determine
  double residual_sum_of_squares = 0.0;  // weighted
  /// Largest over smallest pivot of the scaled design: a lower bound of its
  /// condition number, and rarely far from it.
  double condition = 0.0;
};

/// Least squares by Householder QR with column pivoting on columns scaled to
/// unit length; never the normal equations. Columns that depend on the others
/// to about machine precision get coefficient 0 and are named.
///
/// `design` (n x p), `response` (n), `weights` (n) not negative or (0): equal.
/// Throws std::invalid_argument on shapes that do not agree, n < 1, p < 1, or
/// values that are not finite. n < p is allowed: rank <= n then.
LeastSquaresFit SolveLeastSquares(const Eigen::MatrixXd& design,
                                  const Eigen::VectorXd& response,
                                  const Eigen::VectorXd& weights = {});

}  // namespace errmap::fitting
