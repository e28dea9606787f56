#include "fitting/matrix_product.h"

#include <algorithm>
#include <cassert>
#include <cblas.h>
#include <cstddef>
#include <string_view>
#include <vector>

#include "stats/not_a_number.h"

// LAPACK: Cholesky factorisation, and singular values by divide and conquer.
extern "C" {
void dpotrf_(const char* uplo,
             const int* n,
             double* a,
             const int* lda,
             int* info,
             std::size_t uplo_length);
void dtrtri_(const char* uplo,
             const char* diag,
             const int* n,
             double* a,
             const int* lda,
             int* info,
             std::size_t uplo_length,
             std::size_t diag_length);
void dgesdd_(const char* jobz,
             const int* m,
             const int* n,
             double* a,
             const int* lda,
             double* s,
             double* u,
             const int* ldu,
             double* vt,
             const int* ldvt,
             double* work,
             const int* lwork,
             int* iwork,
             int* info,
             std::size_t jobz_length);
}

namespace errmap::fitting {
namespace {

template <typename Scalar, typename Gemm>
void Call(Gemm gemm,
          CBLAS_TRANSPOSE transpose_b,
          const MatrixView<Scalar>& a,
          const MatrixView<Scalar>& b,
          MutableMatrixView<Scalar>* c,
          bool accumulate) {
  assert(a.rows() == c->rows());
  assert(a.cols() == (transpose_b == CblasTrans ? b.cols() : b.rows()));
  assert(c->cols() == (transpose_b == CblasTrans ? b.rows() : b.cols()));
  UseOneThreadPerCall();
  gemm(CblasColMajor,
       CblasNoTrans,
       transpose_b,
       static_cast<int>(c->rows()),
       static_cast<int>(c->cols()),
       static_cast<int>(a.cols()),
       Scalar(1),
       a.data(),
       static_cast<int>(a.outerStride()),
       b.data(),
       static_cast<int>(b.outerStride()),
       accumulate ? Scalar(1) : Scalar(0),
       c->data(),
       static_cast<int>(c->outerStride()));
}

void CallSyrk(CBLAS_TRANSPOSE transpose,
              const MatrixView<double>& a,
              Index inner,
              MutableMatrixView<double>* c,
              bool accumulate) {
  assert(c->cols() == c->rows());
  UseOneThreadPerCall();
  cblas_dsyrk(CblasColMajor,
              CblasLower,
              transpose,
              static_cast<int>(c->rows()),
              static_cast<int>(inner),
              1.0,
              a.data(),
              static_cast<int>(a.outerStride()),
              accumulate ? 1.0 : 0.0,
              c->data(),
              static_cast<int>(c->outerStride()));
}

}  // namespace

void UseOneThreadPerCall() {
  static const bool once = [] {
    openblas_set_num_threads(1);
    return true;
  }();
  static_cast<void>(once);
}

std::string OpenBlasConfiguration() {
  std::string words = openblas_get_config();
  while (words.ends_with(' ')) words.pop_back();
  constexpr std::string_view kName = "OpenBLAS ";
  if (words.starts_with(kName)) words.erase(0, kName.size());
  return words;
}

void Multiply(const MatrixView<double>& a,
              const MatrixView<double>& b,
              MutableMatrixView<double> c,
              bool accumulate) {
  Call<double>(cblas_dgemm, CblasNoTrans, a, b, &c, accumulate);
}

void Multiply(const MatrixView<float>& a,
              const MatrixView<float>& b,
              MutableMatrixView<float> c,
              bool accumulate) {
  Call<float>(cblas_sgemm, CblasNoTrans, a, b, &c, accumulate);
}

void MultiplyTransposed(const MatrixView<double>& a,
                        const MatrixView<double>& b,
                        MutableMatrixView<double> c,
                        bool accumulate) {
  Call<double>(cblas_dgemm, CblasTrans, a, b, &c, accumulate);
}

void MultiplyTransposed(const MatrixView<float>& a,
                        const MatrixView<float>& b,
                        MutableMatrixView<float> c,
                        bool accumulate) {
  Call<float>(cblas_sgemm, CblasTrans, a, b, &c, accumulate);
}

void MultiplyByOwnTranspose(const MatrixView<double>& a,
                            MutableMatrixView<double> c,
                            bool accumulate) {
  assert(c.rows() == a.rows());
  CallSyrk(CblasNoTrans, a, a.cols(), &c, accumulate);
}

void MultiplyOwnTransposeBy(const MatrixView<double>& a,
                            MutableMatrixView<double> c,
                            bool accumulate) {
  assert(c.rows() == a.cols());
  CallSyrk(CblasTrans, a, a.rows(), &c, accumulate);
}

bool FactorizeCholesky(MutableMatrixView<double> a) {
  assert(a.rows() == a.cols());
  UseOneThreadPerCall();
  const char lower = 'L';
  const int size = static_cast<int>(a.rows());
  const int leading = static_cast<int>(a.outerStride());
  int info = 0;
  dpotrf_(&lower, &size, a.data(), &leading, &info, 1);
  return info == 0;
}

void SolveCholesky(const MatrixView<double>& factor, VectorXd* b) {
  assert(factor.rows() == factor.cols());
  assert(factor.rows() == b->size());
  UseOneThreadPerCall();
  for (const CBLAS_TRANSPOSE transpose : {CblasNoTrans, CblasTrans}) {
    cblas_dtrsv(CblasColMajor,
                CblasLower,
                transpose,
                CblasNonUnit,
                static_cast<int>(factor.rows()),
                factor.data(),
                static_cast<int>(factor.outerStride()),
                b->data(),
                1);
  }
}

VectorXd DiagonalOfInverse(MutableMatrixView<double> factor) {
  assert(factor.rows() == factor.cols());
  UseOneThreadPerCall();
  const char lower = 'L';
  const char not_unit = 'N';
  const int size = static_cast<int>(factor.rows());
  const int leading = static_cast<int>(factor.outerStride());
  int info = 0;
  dtrtri_(&lower, &not_unit, &size, factor.data(), &leading, &info, 1, 1);
  VectorXd diagonal(factor.cols());
  for (Index j = 0; j < diagonal.size(); ++j) {
    diagonal[j] = factor.col(j).tail(diagonal.size() - j).squaredNorm();
  }
  return diagonal;
}

void DivideByUpperTriangle(const MatrixView<double>& r,
                           MutableMatrixView<double> b) {
  assert(r.rows() == r.cols());
  assert(b.cols() == r.cols());
  UseOneThreadPerCall();
  cblas_dtrsm(CblasColMajor,
              CblasRight,
              CblasUpper,
              CblasNoTrans,
              CblasNonUnit,
              static_cast<int>(b.rows()),
              static_cast<int>(b.cols()),
              1.0,
              r.data(),
              static_cast<int>(r.outerStride()),
              b.data(),
              static_cast<int>(b.outerStride()));
}

VectorXd SingularValues(MatrixXd a) {
  UseOneThreadPerCall();
  const char none = 'N';  // no vectors
  const int rows = static_cast<int>(a.rows());
  const int cols = static_cast<int>(a.cols());
  const int one = 1;
  VectorXd values(std::min(rows, cols));
  std::vector<int> integers(8 * static_cast<std::size_t>(values.size()));
  double best_size = 0.0;
  double unused = 0.0;
  int info = 0;
  const auto call = [&](double* work, int size) {
    dgesdd_(&none,
            &rows,
            &cols,
            a.data(),
            &rows,
            values.data(),
            &unused,
            &one,
            &unused,
            &one,
            work,
            &size,
            integers.data(),
            &info,
            1);
  };
  call(&best_size, -1);
  std::vector<double> work(static_cast<std::size_t>(best_size));
  call(work.data(), static_cast<int>(work.size()));
  if (info != 0) values.setConstant(stats::kNaN);
  return values;
}

}  // namespace errmap::fitting
