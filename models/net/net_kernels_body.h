#pragma once

// Implementation of models/net/net_kernels.h. Each net_kernels_<version>.cc
// compiles it with its own compiler options, so everything here must be local
// to that file or inlined: the linker might else use a function of the fastest
// version for the whole program. Hence no standard library and no Eigen.
// Versions with instructions of their own include <immintrin.h> first.

#include <cstddef>

#include "models/net/net_kernels.h"
#include "models/net/net_kernels_logistic.h"
#include "models/net/net_kernels_products.h"
#include "models/net/net_kernels_vectors.h"

namespace errmap::models {
namespace {

// kWide columns share each read of the weights.
template <typename Scalar, int kWide>
ERRMAP_INLINE void OutputColumns(BlockSize size,
                                 std::ptrdiff_t column,
                                 const Scalar* w2,
                                 const Scalar* y,
                                 Scalar* o) {
  const std::ptrdiff_t height = size.height;
  const Scalar* values = y + column * height;
  for (std::ptrdiff_t j = 0; j < size.outputs; ++j) {
    Group<Scalar, kWide> sum = {};
    ForColumn<Scalar>(
        height, [&](auto vector, std::ptrdiff_t h) ERRMAP_INLINED {
          const Vec<Scalar> w = vector.Read(w2 + j * height + h);
#pragma GCC unroll 4
          for (int i = 0; i < kWide; ++i) {
            sum.v[i] =
                MultiplyAdd(w, vector.Read(values + i * height + h), sum.v[i]);
          }
        });
#pragma GCC unroll 4
    for (int i = 0; i < kWide; ++i) {
      o[(column + i) * size.outputs + j] = Sum(sum.v[i]);
    }
  }
}

// Some columns at a time, so that their y are still in the first-level cache
// for the sums.
template <typename Scalar, bool kAlong>
ERRMAP_INLINE void ForwardTiles(BlockSize size,
                                const Scalar* s,
                                const Scalar* t,
                                Scalar a,
                                const Scalar* w2,
                                Scalar* y,
                                Scalar* o) {
  constexpr std::ptrdiff_t kTile = 2048;
  const std::ptrdiff_t height = size.height;
  const std::ptrdiff_t tile = height < kTile ? kTile / height : 1;
  for (std::ptrdiff_t begin = 0; begin < size.columns; begin += tile) {
    const std::ptrdiff_t end =
        begin + tile < size.columns ? begin + tile : size.columns;
    const std::ptrdiff_t first = begin * height;
    LogisticOfVectors<Scalar, kAlong>((end - begin) * height,
                                      s + first,
                                      kAlong ? t + first : nullptr,
                                      a,
                                      y + first);
    constexpr int kTogether = 4;
    std::ptrdiff_t column = begin;
    for (; column + kTogether <= end; column += kTogether) {
      OutputColumns<Scalar, kTogether>(size, column, w2, y, o);
    }
    for (; column < end; ++column) {
      OutputColumns<Scalar, 1>(size, column, w2, y, o);
    }
  }
}

template <typename Scalar>
void Forward(
    BlockSize size, const Scalar* s, const Scalar* w2, Scalar* y, Scalar* o) {
  ForwardTiles<Scalar, false>(size, s, nullptr, Scalar(0), w2, y, o);
}

template <typename Scalar>
void ForwardAlong(BlockSize size,
                  const Scalar* s,
                  const Scalar* t,
                  Scalar a,
                  const Scalar* w2,
                  Scalar* y,
                  Scalar* o) {
  ForwardTiles<Scalar, true>(size, s, t, a, w2, y, o);
}

template <typename Scalar>
void Advance(BlockSize size, const Scalar* t, Scalar a, Scalar* s) {
  ForColumn<Scalar>(size.height * size.columns,
                    [&](auto vector, std::ptrdiff_t i) ERRMAP_INLINED {
                      vector.Write(MultiplyAdd(Vec<Scalar>{} + a,
                                               vector.Read(t + i),
                                               vector.Read(s + i)),
                                   s + i);
                    });
}

// kWide columns share each read of the weights.
template <typename Scalar, int kWide>
ERRMAP_INLINE void BendColumns(BlockSize size,
                               std::ptrdiff_t column,
                               const Scalar* y,
                               const Scalar* t,
                               const Scalar* w2,
                               const Scalar* p2,
                               Scalar* first,
                               Scalar* second) {
  const std::ptrdiff_t height = size.height;
  const Vec<Scalar> one = Vec<Scalar>{} + Scalar(1);
  const Scalar* values = y + column * height;
  const Scalar* along = t + column * height;
  for (std::ptrdiff_t j = 0; j < size.outputs; ++j) {
    Group<Scalar, kWide> sum1 = {};
    Group<Scalar, kWide> sum2 = {};
    ForColumn<Scalar>(
        height, [&](auto vector, std::ptrdiff_t h) ERRMAP_INLINED {
          const Vec<Scalar> w = vector.Read(w2 + j * height + h);
          const Vec<Scalar> p = vector.Read(p2 + j * height + h);
          const Vec<Scalar> twice = p + p;
#pragma GCC unroll 4
          for (int i = 0; i < kWide; ++i) {
            const Vec<Scalar> value = vector.Read(values + i * height + h);
            const Vec<Scalar> step = vector.Read(along + i * height + h);
            // y' = y (1 - y) t and y'' = y' (1 - 2 y) t.
            const Vec<Scalar> slope = MultiplyAdd(-value, value, value) * step;
            const Vec<Scalar> bend = (one - (value + value)) * step;
            sum1.v[i] = MultiplyAdd(p, value, sum1.v[i]);
            sum1.v[i] = MultiplyAdd(w, slope, sum1.v[i]);
            sum2.v[i] =
                MultiplyAdd(slope, MultiplyAdd(w, bend, twice), sum2.v[i]);
          }
        });
#pragma GCC unroll 4
    for (int i = 0; i < kWide; ++i) {
      first[(column + i) * size.outputs + j] = Sum(sum1.v[i]);
      second[(column + i) * size.outputs + j] = Sum(sum2.v[i]);
    }
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
  constexpr int kTogether = 4;
  std::ptrdiff_t column = 0;
  for (; column + kTogether <= size.columns; column += kTogether) {
    BendColumns<Scalar, kTogether>(size, column, y, t, w2, p2, first, second);
  }
  for (; column < size.columns; ++column) {
    BendColumns<Scalar, 1>(size, column, y, t, w2, p2, first, second);
  }
}

// For one output: a vector, or half a vector, of hidden nodes. It goes through
// all columns while its sum stays in a register.
template <typename Scalar, typename Vector>
struct BackwardVector {
  Vec<Scalar> w;
  Vec<Scalar> sum;

  ERRMAP_INLINE void Begin(const Scalar* w2, const Scalar* d_w2) {
    w = Vector::Read(w2);
    sum = Vector::Read(d_w2);
  }
  ERRMAP_INLINE void Add(const Scalar* y,
                         const Vec<Scalar>& by_output,
                         Scalar* delta) {
    const Vec<Scalar> value = Vector::Read(y);
    sum = MultiplyAdd(value, by_output, sum);
    Vector::Write(w * by_output * MultiplyAdd(-value, value, value), delta);
  }
};

// kCount vectors from row h on of all columns, and half a vector below them if
// kHalf, side by side: each sum alone would wait for its own additions.
template <typename Scalar, int kCount, bool kHalf>
ERRMAP_INLINE void BackwardRows(BlockSize size,
                                std::ptrdiff_t h,
                                const Scalar* y,
                                const Scalar* w2,
                                const Scalar* d_output,
                                Scalar* delta,
                                Scalar* d_w2) {
  constexpr std::ptrdiff_t kWhole = kCount * kLanes<Scalar>;
  BackwardVector<Scalar, WholeVector> rows[kCount > 0 ? kCount : 1];
  BackwardVector<Scalar, HalfVector> half;
#pragma GCC unroll 4
  for (int i = 0; i < kCount; ++i) {
    rows[i].Begin(w2 + h + i * kLanes<Scalar>, d_w2 + h + i * kLanes<Scalar>);
  }
  if constexpr (kHalf) half.Begin(w2 + h + kWhole, d_w2 + h + kWhole);
  for (std::ptrdiff_t column = 0; column < size.columns; ++column) {
    const std::ptrdiff_t begin = column * size.height + h;
    const Vec<Scalar> by_output = Repeated<Vec<Scalar>>(d_output[column]);
#pragma GCC unroll 4
    for (int i = 0; i < kCount; ++i) {
      rows[i].Add(y + begin + i * kLanes<Scalar>,
                  by_output,
                  delta + begin + i * kLanes<Scalar>);
    }
    if constexpr (kHalf) {
      half.Add(y + begin + kWhole, by_output, delta + begin + kWhole);
    }
  }
#pragma GCC unroll 4
  for (int i = 0; i < kCount; ++i) {
    WholeVector::Write(rows[i].sum, d_w2 + h + i * kLanes<Scalar>);
  }
  if constexpr (kHalf) HalfVector::Write(half.sum, d_w2 + h + kWhole);
}

// The rows from h on: fewer than four vectors, and half a vector if kHalf.
template <typename Scalar, bool kHalf>
ERRMAP_INLINE void BackwardRest(BlockSize size,
                                std::ptrdiff_t h,
                                const Scalar* y,
                                const Scalar* w2,
                                const Scalar* d_output,
                                Scalar* delta,
                                Scalar* d_w2) {
  switch ((size.height - h) / kLanes<Scalar>) {
    case 3:
      BackwardRows<Scalar, 3, kHalf>(size, h, y, w2, d_output, delta, d_w2);
      return;
    case 2:
      BackwardRows<Scalar, 2, kHalf>(size, h, y, w2, d_output, delta, d_w2);
      return;
    case 1:
      BackwardRows<Scalar, 1, kHalf>(size, h, y, w2, d_output, delta, d_w2);
      return;
    default:
      if constexpr (kHalf) {
        BackwardRows<Scalar, 0, true>(size, h, y, w2, d_output, delta, d_w2);
      }
  }
}

template <typename Scalar>
void BackwardOfOne(BlockSize size,
                   const Scalar* y,
                   const Scalar* w2,
                   const Scalar* d_output,
                   Scalar* delta,
                   Scalar* d_w2) {
  constexpr int kTogether = 4;
  constexpr std::ptrdiff_t kStep = kTogether * kLanes<Scalar>;
  std::ptrdiff_t h = 0;
  for (; h + kStep <= size.height; h += kStep) {
    BackwardRows<Scalar, kTogether, false>(
        size, h, y, w2, d_output, delta, d_w2);
  }
  if constexpr (kHasHalves) {
    if (size.height % kLanes<Scalar> != 0) {
      BackwardRest<Scalar, true>(size, h, y, w2, d_output, delta, d_w2);
      return;
    }
  }
  BackwardRest<Scalar, false>(size, h, y, w2, d_output, delta, d_w2);
}

template <typename Scalar>
void Backward(BlockSize size,
              const Scalar* y,
              const Scalar* w2,
              const Scalar* d_output,
              Scalar* delta,
              Scalar* d_w2) {
  if (size.outputs == 1) {
    BackwardOfOne(size, y, w2, d_output, delta, d_w2);
    return;
  }
  const std::ptrdiff_t height = size.height;
  for (std::ptrdiff_t column = 0; column < size.columns; ++column) {
    const std::ptrdiff_t begin = column * height;
    const Scalar* d = d_output + column * size.outputs;
    ForColumn<Scalar>(
        height, [&](auto vector, std::ptrdiff_t h) ERRMAP_INLINED {
          const Vec<Scalar> value = vector.Read(y + begin + h);
          Vec<Scalar> back = {};
          for (std::ptrdiff_t j = 0; j < size.outputs; ++j) {
            const Vec<Scalar> by_output = Vec<Scalar>{} + d[j];
            Scalar* sum = d_w2 + j * height + h;
            back =
                MultiplyAdd(vector.Read(w2 + j * height + h), by_output, back);
            vector.Write(MultiplyAdd(value, by_output, vector.Read(sum)), sum);
          }
          vector.Write(back * MultiplyAdd(-value, value, value),
                       delta + begin + h);
        });
  }
}

template <typename Scalar>
void Activate(BlockSize size,
              std::ptrdiff_t inner,
              const Scalar* w1,
              const Scalar* x,
              Scalar* s) {
  MultiplyAll<Scalar, false>(
      {inner, w1, size.height, x, 1, inner, s, size.height},
      size.height,
      size.columns);
}

template <typename Scalar>
void AddProducts(BlockSize size,
                 std::ptrdiff_t inner,
                 const Scalar* delta,
                 const Scalar* x,
                 bool anew,
                 Scalar* d_w1) {
  const Factors<Scalar> factors = {
      size.columns, delta, size.height, x, inner, 1, d_w1, size.height};
  if (anew) {
    MultiplyAll<Scalar, false>(factors, size.height, inner);
  } else {
    MultiplyAll<Scalar, true>(factors, size.height, inner);
  }
}

template <typename Scalar>
constexpr NetKernels<Scalar> MakeNetKernels(const char* name) {
  return {name,
          Activate<Scalar>,
          AddProducts<Scalar>,
          Logistic<Scalar>,
          Forward<Scalar>,
          ForwardAlong<Scalar>,
          Advance<Scalar>,
          BendAlong<Scalar>,
          Backward<Scalar>};
}

}  // namespace
}  // namespace errmap::models

#undef ERRMAP_INLINED
#undef ERRMAP_INLINE
