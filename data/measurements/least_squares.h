#pragma once

#include <Eigen/Core>

namespace errmap::data {

/// The b (p) that makes |design b - wanted| least, by a QR decomposition
/// with column pivots; some such b where columns depend on each other. design:
/// (n x p), wanted: (n).
Eigen::VectorXd SolveLeastSquares(const Eigen::MatrixXd& design,
                                  const Eigen::VectorXd& wanted);

}  // namespace errmap::data
