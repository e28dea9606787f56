#include "tests/decompositions.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace errmap::testing {

using Eigen::MatrixXd;

Eigen::VectorXd SingularValues(const MatrixXd& a) {
  return Eigen::JacobiSVD<MatrixXd>(a).singularValues();
}

MatrixXd LeastSquares(const MatrixXd& a, const MatrixXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

MatrixXd SolveSymmetric(const MatrixXd& a, const MatrixXd& b) {
  return a.ldlt().solve(b);
}

}  // namespace errmap::testing
