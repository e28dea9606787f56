#include <cmath>

#include <Eigen/Core>

#include "models/net/net_kernels.h"

namespace errmap::models {
namespace {

// Only the formulas, summed in order; the products are those of Eigen.

template <typename Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <typename Scalar>
using ConstMap = Eigen::Map<const Matrix<Scalar>>;

template <typename Scalar>
void Activate(BlockSize size,
              std::ptrdiff_t inner,
              const Scalar* w1,
              const Scalar* x,
              Scalar* s) {
  Eigen::Map<Matrix<Scalar>>(s, size.height, size.columns).noalias() =
      ConstMap<Scalar>(w1, size.height, inner) *
      ConstMap<Scalar>(x, inner, size.columns);
}

template <typename Scalar>
void AddProducts(BlockSize size,
                 std::ptrdiff_t inner,
                 const Scalar* delta,
                 const Scalar* x,
                 bool anew,
                 Scalar* d_w1) {
  Eigen::Map<Matrix<Scalar>> sum(d_w1, size.height, inner);
  if (anew) sum.setZero();
  sum.noalias() += ConstMap<Scalar>(delta, size.height, size.columns) *
                   ConstMap<Scalar>(x, inner, size.columns).transpose();
}

template <typename Scalar>
void Logistic(std::ptrdiff_t n, const Scalar* s, Scalar* y) {
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    y[i] = Scalar(1) / (Scalar(1) + std::exp(-s[i]));
  }
}

template <typename Scalar>
void Forward(
    BlockSize size, const Scalar* s, const Scalar* w2, Scalar* y, Scalar* o) {
  Logistic(size.height * size.columns, s, y);
  for (std::ptrdiff_t column = 0; column < size.columns; ++column) {
    for (std::ptrdiff_t j = 0; j < size.outputs; ++j) {
      Scalar sum = 0;
      for (std::ptrdiff_t h = 0; h < size.height; ++h) {
        sum += w2[j * size.height + h] * y[column * size.height + h];
      }
      o[column * size.outputs + j] = sum;
    }
  }
}

template <typename Scalar>
void ForwardAlong(BlockSize size,
                  const Scalar* s,
                  const Scalar* t,
                  Scalar a,
                  const Scalar* w2,
                  Scalar* y,
                  Scalar* o) {
  for (std::ptrdiff_t i = 0; i < size.height * size.columns; ++i) {
    y[i] = s[i] + a * t[i];
  }
  Forward(size, y, w2, y, o);
}

template <typename Scalar>
void Advance(BlockSize size, const Scalar* t, Scalar a, Scalar* s) {
  for (std::ptrdiff_t i = 0; i < size.height * size.columns; ++i) {
    s[i] = s[i] + a * t[i];
  }
}

template <typename Scalar>
void BendAlong(BlockSize size,
               const Scalar* y,
               const Scalar* t,
               const Scalar* w2,
               const Scalar* p2,
               Scalar* first,
               Scalar* second) {
  for (std::ptrdiff_t column = 0; column < size.columns; ++column) {
    for (std::ptrdiff_t j = 0; j < size.outputs; ++j) {
      Scalar sum1 = 0;
      Scalar sum2 = 0;
      for (std::ptrdiff_t h = 0; h < size.height; ++h) {
        const Scalar value = y[column * size.height + h];
        const Scalar step = t[column * size.height + h];
        const Scalar w = w2[j * size.height + h];
        const Scalar p = p2[j * size.height + h];
        const Scalar slope = value * (Scalar(1) - value) * step;
        const Scalar bend = slope * (Scalar(1) - Scalar(2) * value) * step;
        sum1 += p * value + w * slope;
        sum2 += Scalar(2) * p * slope + w * bend;
      }
      first[column * size.outputs + j] = sum1;
      second[column * size.outputs + j] = sum2;
    }
  }
}

template <typename Scalar>
void Backward(BlockSize size,
              const Scalar* y,
              const Scalar* w2,
              const Scalar* d_output,
              Scalar* delta,
              Scalar* d_w2) {
  for (std::ptrdiff_t column = 0; column < size.columns; ++column) {
    const Scalar* d = d_output + column * size.outputs;
    for (std::ptrdiff_t h = 0; h < size.height; ++h) {
      const Scalar value = y[column * size.height + h];
      Scalar back = 0;
      for (std::ptrdiff_t j = 0; j < size.outputs; ++j) {
        back += w2[j * size.height + h] * d[j];
        d_w2[j * size.height + h] += value * d[j];
      }
      delta[column * size.height + h] = back * value * (Scalar(1) - value);
    }
  }
}

}  // namespace

template <typename Scalar>
const NetKernels<Scalar>& PlainNetKernels() {
  static const NetKernels<Scalar> kernels = {"plain",
                                             Activate<Scalar>,
                                             AddProducts<Scalar>,
                                             Logistic<Scalar>,
                                             Forward<Scalar>,
                                             ForwardAlong<Scalar>,
                                             Advance<Scalar>,
                                             BendAlong<Scalar>,
                                             Backward<Scalar>};
  return kernels;
}

template const NetKernels<double>& PlainNetKernels();
template const NetKernels<float>& PlainNetKernels();

}  // namespace errmap::models
