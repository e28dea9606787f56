#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "stats/eigen.h"

// Eigen's decompositions of a MatrixXd and their solvers for a VectorXd or
// MatrixXd, compiled once, in decompositions.cc: each takes the compiler longer
// than the file that calls it. An expression instead of a named matrix would be
// compiled again, so give it a name first.
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

/// Returns Q' vector (n) of A = Q R.
VectorXd TimesQTransposed(const Eigen::HouseholderQR<MatrixXd>& qr,
                          const VectorXd& vector);

/// Returns the first p columns of Q (n x p) of A = Q R.
MatrixXd ThinQ(const Eigen::HouseholderQR<MatrixXd>& qr);

/// Returns the inverse of a symmetric, positive definite matrix by Cholesky.
MatrixXd CholeskyInverse(const MatrixXd& matrix);

}  // namespace errmap::fitting
