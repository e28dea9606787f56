#pragma once

#include <string>

#include "stats/eigen.h"

namespace errmap::fitting {

/// Column-major matrix with any column stride; binds without a copy.
template <typename Scalar>
using MatrixView =
    Eigen::Ref<const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>,
               0,
               Eigen::OuterStride<>>;
template <typename Scalar>
using MutableMatrixView =
    Eigen::Ref<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>,
               0,
               Eigen::OuterStride<>>;

/// Makes OpenBLAS use one thread per call in this process from now on. Equal
/// calls then give equal bits whatever else is running, and callers decide how
/// to use the cores. All functions below call it.
void UseOneThreadPerCall();

/// Returns OpenBLAS' own text on its version and options, and the processor
/// type of its kernels. The last bits of a product depend on them.
std::string OpenBlasConfiguration();

/// Computes c = a b, or c += a b if `accumulate`, by OpenBLAS, with a (m x k),
/// b (k x n), c (m x n), none of them empty.
void Multiply(const MatrixView<double>& a,
              const MatrixView<double>& b,
              MutableMatrixView<double> c,
              bool accumulate = false);
void Multiply(const MatrixView<float>& a,
              const MatrixView<float>& b,
              MutableMatrixView<float> c,
              bool accumulate = false);

/// Computes the same for a b', b (n x k).
void MultiplyTransposed(const MatrixView<double>& a,
                        const MatrixView<double>& b,
                        MutableMatrixView<double> c,
                        bool accumulate = false);
void MultiplyTransposed(const MatrixView<float>& a,
                        const MatrixView<float>& b,
                        MutableMatrixView<float> c,
                        bool accumulate = false);

/// Computes the lower triangle of c = a a', or c += a a' if `accumulate`, for a
/// (m x k), c (m x m), neither empty. Leaves c above the diagonal unchanged.
void MultiplyByOwnTranspose(const MatrixView<double>& a,
                            MutableMatrixView<double> c,
                            bool accumulate = false);

/// Computes the same for c = a' a, a (k x m).
void MultiplyOwnTransposeBy(const MatrixView<double>& a,
                            MutableMatrixView<double> c,
                            bool accumulate = false);

/// Replaces the lower triangle of a symmetric matrix (m x m) by its Cholesky
/// factor L; reads only that triangle. Returns false if the matrix is not
/// positive definite to rounding; its content is then lost.
bool FactorizeCholesky(MutableMatrixView<double> a);

/// Solves L L'x = b, with L (m x m) from FactorizeCholesky; overwrites b (m)
/// with x.
void SolveCholesky(const MatrixView<double>& factor, VectorXd* b);

/// Returns the diagonal (m) of (L L')^-1, with L from FactorizeCholesky;
/// destroys the content of `factor`.
VectorXd DiagonalOfInverse(MutableMatrixView<double> factor);

/// Computes b = b r^-1 for r (k x k) upper triangular without zeros on its
/// diagonal, and b (m x k).
void DivideByUpperTriangle(const MatrixView<double>& r,
                           MutableMatrixView<double> b);

/// Returns the min(m, n) singular values of a (m x n, neither empty), largest
/// first; all NaN if they were not found.
VectorXd SingularValues(MatrixXd a);

}  // namespace errmap::fitting
