#include "fitting/least_squares/decompositions.h"

namespace Eigen {

template void HouseholderQR<MatrixXd>::computeInPlace();
template void HouseholderQR<MatrixXd>::_solve_impl(const VectorXd&,
                                                   VectorXd&) const;
template void ColPivHouseholderQR<MatrixXd>::computeInPlace();
template void ColPivHouseholderQR<MatrixXd>::_solve_impl(const VectorXd&,
                                                         VectorXd&) const;
template SelfAdjointEigenSolver<MatrixXd>&
SelfAdjointEigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, int);
template LDLT<MatrixXd>& LDLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
template void LDLT<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
template void LDLT<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;

}  // namespace Eigen

namespace errmap::fitting {

Eigen::VectorXd TimesQTransposed(
    const Eigen::HouseholderQR<Eigen::MatrixXd>& qr,
    const Eigen::VectorXd& vector) {
  return qr.householderQ().transpose() * vector;
}

Eigen::MatrixXd ThinQ(const Eigen::HouseholderQR<Eigen::MatrixXd>& qr) {
  return qr.householderQ() * Eigen::MatrixXd::Identity(qr.rows(), qr.cols());
}

Eigen::MatrixXd CholeskyInverse(const Eigen::MatrixXd& matrix) {
  return matrix.llt().solve(
      Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
}

}  // namespace errmap::fitting
