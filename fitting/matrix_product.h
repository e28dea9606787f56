#pragma once

#include <string>

#include <Eigen/Core>

namespace errmap::fitting {

/// Column-major matrix with any distance between columns; binds without a copy.
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

/// Makes OpenBLAS, in this process and from now on, use one thread per call:
/// the same call then gives the same bits beside any number of others, and the
/// cores are shared out by those who know the work. Called by all below.
void UseOneThreadPerCall();

/// Version and options of OpenBLAS in its own words, and the processor whose
/// kernels it took: the last bits of a product depend on them.
std::string OpenBlasConfiguration();

/// c = a b, or c += a b where `accumulate`, with a (m x k), b (k x n), c (m x
/// n), none of them empty; by OpenBLAS.
void Multiply(const MatrixView<double>& a,
              const MatrixView<double>& b,
              MutableMatrixView<double> c,
              bool accumulate = false);
void Multiply(const MatrixView<float>& a,
              const MatrixView<float>& b,
              MutableMatrixView<float> c,
              bool accumulate = false);

/// The same for a b', b (n x k).
void MultiplyTransposed(const MatrixView<double>& a,
                        const MatrixView<double>& b,
                        MutableMatrixView<double> c,
                        bool accumulate = false);
void MultiplyTransposed(const MatrixView<float>& a,
                        const MatrixView<float>& b,
                        MutableMatrixView<float> c,
                        bool accumulate = false);

/// The lower triangle of c = a a', or c += a a' where `accumulate`, a (m x k),
/// c (m x m), neither empty; what stands above the diagonal is left as it is.
void MultiplyByOwnTranspose(const MatrixView<double>& a,
                            MutableMatrixView<double> c,
                            bool accumulate = false);

/// The same of c = a' a, a (k x m).
void MultiplyOwnTransposeBy(const MatrixView<double>& a,
                            MutableMatrixView<double> c,
                            bool accumulate = false);

/// Cholesky factor L of a symmetric matrix (m x m) in the place of its lower
/// triangle, which alone is read. False where it is not positive definite to
/// rounding; its content is then lost.
bool FactorizeCholesky(MutableMatrixView<double> a);

/// Solves L L'x = b, with L (m x m) as FactorizeCholesky leaves it, in the
/// place of b (m).
void SolveCholesky(const MatrixView<double>& factor, Eigen::VectorXd* b);

/// (m) Diagonal of (L L')^-1, with L as FactorizeCholesky leaves it, whose
/// content is then lost.
Eigen::VectorXd DiagonalOfInverse(MutableMatrixView<double> factor);

/// b = b r^-1: r (k x k) upper triangular with no zero on its diagonal, b (m x
/// k).
void DivideByUpperTriangle(const MatrixView<double>& r,
                           MutableMatrixView<double> b);

/// The singular values of a (m x n, neither empty), largest first, min(m, n) of
/// them; NaN throughout where they were not found.
Eigen::VectorXd SingularValues(Eigen::MatrixXd a);

}  // namespace errmap::fitting
