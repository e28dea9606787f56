#pragma once

// Products of small matrices: a part of net_kernels_body.h.

#include <cstddef>

#include "models/net/net_kernels_vectors.h"

namespace errmap::models {
namespace {

// A tile of the result, `kTall` vectors by `kWide` columns, stays in registers
// during the loop over the inner dimension. Nothing is packed: matrices of nets
// are small enough for the first-level cache.

// Sizes that fill the registers: 32 with AVX-512, else 16.
#if defined(__AVX512F__)
constexpr int kTallest = 4;
constexpr int WidestOf(int tall) { return tall > 2 ? 24 / tall : 12; }
#elif defined(__AVX2__)
constexpr int kTallest = 2;
constexpr int WidestOf(int) { return 6; }
#else
constexpr int kTallest = 2;
constexpr int WidestOf(int) { return 4; }
#endif

// c (+)= a b over `inner` steps k: column k of a begins at a + k stride_a,
// element (k, j) of b is at b + k inner_b + j column_b, column j of c begins at
// c + j stride_c.
template <typename Scalar>
struct Factors {
  std::ptrdiff_t inner;
  const Scalar* a;
  std::ptrdiff_t stride_a;
  const Scalar* b;
  std::ptrdiff_t inner_b;
  std::ptrdiff_t column_b;
  Scalar* c;
  std::ptrdiff_t stride_c;
};

// The half vectors of kWide columns, two columns per vector if there are two;
// `value(j)` is the factor of column j.
template <typename Scalar, int kWide>
struct HalfVectors {
  static constexpr int kPairs = kHasHalves ? kWide / 2 : 0;
  static constexpr bool kHasLast = kWide > 2 * kPairs;
  Group<Scalar, (kPairs > 0 ? kPairs : 1)> pairs = {};
  Half<Scalar> last = {};

  ERRMAP_INLINE void Read(const Scalar* c, std::ptrdiff_t stride) {
#pragma GCC unroll 6
    for (int j = 0; j < kPairs; ++j) {
      pairs.v[j] = Joined(LoadHalf(c + 2 * j * stride),
                          LoadHalf(c + (2 * j + 1) * stride));
    }
    if constexpr (kHasLast) last = LoadHalf(c + 2 * kPairs * stride);
  }
  template <typename Value>
  ERRMAP_INLINE void Add(const Half<Scalar>& left, Value value) {
    const Vec<Scalar> twice = Twice(left);
#pragma GCC unroll 6
    for (int j = 0; j < kPairs; ++j) {
      pairs.v[j] = MultiplyAdd(
          twice, HalfOfEach(value(2 * j), value(2 * j + 1)), pairs.v[j]);
    }
    if constexpr (kHasLast) {
      last = MultiplyAdd(left, FirstHalf(value(2 * kPairs)), last);
    }
  }
  ERRMAP_INLINE void Write(Scalar* c, std::ptrdiff_t stride) const {
#pragma GCC unroll 6
    for (int j = 0; j < kPairs; ++j) {
      StoreHalf<Scalar>(FirstHalf(pairs.v[j]), c + 2 * j * stride);
      StoreHalf<Scalar>(SecondHalf(pairs.v[j]), c + (2 * j + 1) * stride);
    }
    if constexpr (kHasLast) StoreHalf<Scalar>(last, c + 2 * kPairs * stride);
  }
};

// kTall vectors, and half a vector below them if kHalf.
template <typename Scalar, bool kAdd, int kTall, bool kHalf, int kWide>
ERRMAP_INLINE void MultiplyTile(const Factors<Scalar>& f,
                                std::ptrdiff_t row,
                                std::ptrdiff_t column) {
  constexpr std::ptrdiff_t kWhole = kTall * kLanes<Scalar>;
  const Scalar* a = f.a + row;
  const Scalar* b = f.b + column * f.column_b;
  Scalar* c = f.c + column * f.stride_c + row;
  Group<Scalar, (kTall > 0 ? kTall : 1)> sums[kWide];
  HalfVectors<Scalar, kWide> halves;
#pragma GCC unroll 12
  for (int j = 0; j < kWide; ++j) {
#pragma GCC unroll 4
    for (int i = 0; i < kTall; ++i) {
      sums[j].v[i] =
          kAdd ? Load(c + j * f.stride_c + i * kLanes<Scalar>) : Vec<Scalar>{};
    }
  }
  if constexpr (kHalf && kAdd) halves.Read(c + kWhole, f.stride_c);
#pragma GCC unroll 2
  for (std::ptrdiff_t k = 0; k < f.inner; ++k) {
    Group<Scalar, (kTall > 0 ? kTall : 1)> left;
    Group<Scalar, kWide> right;
#pragma GCC unroll 4
    for (int i = 0; i < kTall; ++i) {
      left.v[i] = Load(a + k * f.stride_a + i * kLanes<Scalar>);
    }
#pragma GCC unroll 12
    for (int j = 0; j < kWide; ++j) {
      const Scalar value = b[k * f.inner_b + j * f.column_b];
      right.v[j] = Repeated<Vec<Scalar>>(value);
#pragma GCC unroll 4
      for (int i = 0; i < kTall; ++i) {
        sums[j].v[i] = MultiplyAdd(left.v[i], right.v[j], sums[j].v[i]);
      }
    }
    if constexpr (kHalf) {
      halves.Add(LoadHalf(a + k * f.stride_a + kWhole),
                 [&](int j) ERRMAP_INLINED { return right.v[j]; });
    }
  }
#pragma GCC unroll 12
  for (int j = 0; j < kWide; ++j) {
#pragma GCC unroll 4
    for (int i = 0; i < kTall; ++i) {
      Store<Scalar>(sums[j].v[i], c + j * f.stride_c + i * kLanes<Scalar>);
    }
  }
  if constexpr (kHalf) halves.Write(c + kWhole, f.stride_c);
}

// All tiles of kWide columns from *column on.
template <typename Scalar, bool kAdd, int kTall, bool kHalf, int kWide>
ERRMAP_INLINE void MultiplyColumns(const Factors<Scalar>& f,
                                   std::ptrdiff_t row,
                                   std::ptrdiff_t columns,
                                   std::ptrdiff_t* column) {
  for (; *column + kWide <= columns; *column += kWide) {
    MultiplyTile<Scalar, kAdd, kTall, kHalf, kWide>(f, row, *column);
  }
}

// The rows from `row` on that fill kTall vectors, and half a vector.
template <typename Scalar, bool kAdd, int kTall, bool kHalf>
void MultiplyRows(const Factors<Scalar>& f,
                  std::ptrdiff_t row,
                  std::ptrdiff_t columns) {
  constexpr int kWidest = WidestOf(kTall + (kHalf ? 1 : 0));
  std::ptrdiff_t column = 0;
  MultiplyColumns<Scalar, kAdd, kTall, kHalf, kWidest>(
      f, row, columns, &column);
  MultiplyColumns<Scalar, kAdd, kTall, kHalf, 4>(f, row, columns, &column);
  MultiplyColumns<Scalar, kAdd, kTall, kHalf, 2>(f, row, columns, &column);
  MultiplyColumns<Scalar, kAdd, kTall, kHalf, 1>(f, row, columns, &column);
}

// The last `rest` vectors, fewer than kTallest, and half a vector.
template <typename Scalar, bool kAdd, bool kHalf>
ERRMAP_INLINE void MultiplyRest(const Factors<Scalar>& f,
                                std::ptrdiff_t row,
                                std::ptrdiff_t rest,
                                std::ptrdiff_t columns) {
  if constexpr (kTallest > 2) {
    if (rest == 3) MultiplyRows<Scalar, kAdd, 3, kHalf>(f, row, columns);
    if (rest == 2) MultiplyRows<Scalar, kAdd, 2, kHalf>(f, row, columns);
  }
  if (rest == 1) MultiplyRows<Scalar, kAdd, 1, kHalf>(f, row, columns);
  if constexpr (kHalf) {
    if (rest == 0) MultiplyRows<Scalar, kAdd, 0, kHalf>(f, row, columns);
  }
}

template <typename Scalar, bool kAdd>
ERRMAP_INLINE void MultiplyAll(const Factors<Scalar>& f,
                               std::ptrdiff_t height,
                               std::ptrdiff_t columns) {
  constexpr std::ptrdiff_t kRows = kTallest * kLanes<Scalar>;
  std::ptrdiff_t row = 0;
  for (; row + kRows <= height; row += kRows) {
    MultiplyRows<Scalar, kAdd, kTallest, false>(f, row, columns);
  }
  const std::ptrdiff_t rest = (height - row) / kLanes<Scalar>;
  if constexpr (kHasHalves) {
    if ((height - row) % kLanes<Scalar> != 0) {
      MultiplyRest<Scalar, kAdd, true>(f, row, rest, columns);
      return;
    }
  }
  MultiplyRest<Scalar, kAdd, false>(f, row, rest, columns);
}

}  // namespace
}  // namespace errmap::models
