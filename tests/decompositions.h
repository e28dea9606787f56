#pragma once

#include <Eigen/Core>

namespace errmap::testing {

// Eigen's decompositions, compiled once: each takes a compiler longer than the
// tests that ask for it.

/// Singular values of `a` (n x p), the largest first.
Eigen::VectorXd SingularValues(const Eigen::MatrixXd& a);

/// The x (p x k) of the least |a x - b|; `a` (n x p) of full rank, `b` (n x k).
Eigen::MatrixXd LeastSquares(const Eigen::MatrixXd& a,
                             const Eigen::MatrixXd& b);

/// The x (n x k) of a x = b; `a` (n x n) symmetric, `b` (n x k).
Eigen::MatrixXd SolveSymmetric(const Eigen::MatrixXd& a,
                               const Eigen::MatrixXd& b);

}  // namespace errmap::testing
