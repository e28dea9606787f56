#pragma once

#include <Eigen/Core>

namespace errmap::data {

/// Returns the b (p) that minimises |design b - wanted|, by a QR decomposition
/// with column pivoting; one of several such b if columns are dependent.
/// design: (n x p), wanted: (n).
Eigen::VectorXd SolveLeastSquares(const Eigen::MatrixXd& design,
                                  const Eigen::VectorXd& wanted);

}  // namespace errmap::data
