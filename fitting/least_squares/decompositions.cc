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

VectorXd TimesQTransposed(const Eigen::HouseholderQR<MatrixXd>& qr,
                          const VectorXd& vector) {
  return qr.householderQ().transpose() * vector;
}

MatrixXd ThinQ(const Eigen::HouseholderQR<MatrixXd>& qr) {
  return qr.householderQ() * MatrixXd::Identity(qr.rows(), qr.cols());
}

MatrixXd CholeskyInverse(const MatrixXd& matrix) {
  return matrix.llt().solve(MatrixXd::Identity(matrix.rows(), matrix.cols()));
}

}  // namespace errmap::fitting
