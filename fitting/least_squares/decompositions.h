#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

// Eigen's decompositions of a MatrixXd, and what they solve for a VectorXd or a
// MatrixXd, compiled once, in decompositions.cc: each takes a compiler longer
// than the file that calls it. An expression in the place of the matrix would
// be compiled anew: give it a name first.
namespace Eigen {

extern template void HouseholderQR<MatrixXd>::computeInPlace();
extern template void HouseholderQR<MatrixXd>::_solve_impl(const VectorXd&,
                                                          VectorXd&) const;
extern template void ColPivHouseholderQR<MatrixXd>::computeInPlace();
extern template void ColPivHouseholderQR<MatrixXd>::_solve_impl(
    const VectorXd&, VectorXd&) const;
extern template SelfAdjointEigenSolver<MatrixXd>&
SelfAdjointEigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, int);
extern template LDLT<MatrixXd>& LDLT<MatrixXd>::compute(
    const EigenBase<MatrixXd>&);
extern template void LDLT<MatrixXd>::_solve_impl(const VectorXd&,
                                                 VectorXd&) const;
extern template void LDLT<MatrixXd>::_solve_impl(const MatrixXd&,
                                                 MatrixXd&) const;

}  // namespace Eigen

namespace errmap::fitting {

/// Q' vector, (n), of A = Q R.
Eigen::VectorXd TimesQTransposed(
    const Eigen::HouseholderQR<Eigen::MatrixXd>& qr,
    const Eigen::VectorXd& vector);

/// The first p columns of Q, (n x p), of A = Q R.
Eigen::MatrixXd ThinQ(const Eigen::HouseholderQR<Eigen::MatrixXd>& qr);

/// Inverse of a symmetric, positive definite matrix (n x n) by Cholesky.
Eigen::MatrixXd CholeskyInverse(const Eigen::MatrixXd& matrix);

}  // namespace errmap::fitting
