#pragma once

// Vectors as wide as the compiler options of this version allow. A part of
// net_kernels_body.h, which says what this file may contain.

#include <cstddef>
#include <cstdint>

#include "models/net/net_kernels.h"

#define ERRMAP_INLINE __attribute__((always_inline)) inline
#define ERRMAP_INLINED __attribute__((always_inline))  // of a lambda

namespace errmap::models {
namespace {

// The width of this version's vectors; the compiler splits wider ones badly.
#if defined(__AVX512F__)
constexpr std::ptrdiff_t kBytes = 64;
#elif defined(__AVX2__)
constexpr std::ptrdiff_t kBytes = 32;
#else
constexpr std::ptrdiff_t kBytes = 16;
#endif

// The portable vectors of GCC and Clang.
template <typename Scalar>
struct VectorTypes;
template <>
struct VectorTypes<double> {
  using Values = double __attribute__((vector_size(kBytes)));
  using Bits = std::int64_t __attribute__((vector_size(kBytes)));
};
template <>
struct VectorTypes<float> {
  using Values = float __attribute__((vector_size(kBytes)));
  using Bits = std::int32_t __attribute__((vector_size(kBytes)));
};
template <typename Scalar>
using Vec = typename VectorTypes<Scalar>::Values;
template <typename Scalar>
constexpr std::ptrdiff_t kLanes = kBytes /
                                  static_cast<std::ptrdiff_t>(sizeof(Scalar));
static_assert(kVectorBytes % kBytes == 0);
// True if a height may end in half a vector.
constexpr bool kHasHalves = kPaddingBytes < kBytes;
static_assert(kPaddingBytes % kBytes == 0 || kBytes == 2 * kPaddingBytes);

template <typename Scalar>
ERRMAP_INLINE Vec<Scalar> Load(const Scalar* from) {
  Vec<Scalar> v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

template <typename Scalar>
ERRMAP_INLINE void Store(const Vec<Scalar>& v, Scalar* to) {
  __builtin_memcpy(to, &v, sizeof v);
}

// x - 0 is x, whatever its sign: one instruction.
template <typename Values, typename Scalar>
ERRMAP_INLINE Values Repeated(Scalar value) {
  return value - Values{};
}

template <typename Scalar, std::ptrdiff_t kCount>
using Pack __attribute__((vector_size(kCount * sizeof(Scalar)))) = Scalar;

// a b + c, rounded once if the machine can. Explicit, since the compiler is not
// allowed to contract products and sums by itself (-ffp-contract=off).
#if defined(__FMA__)
ERRMAP_INLINE Pack<double, 4> MultiplyAdd(Pack<double, 4> a,
                                          Pack<double, 4> b,
                                          Pack<double, 4> c) {
  return _mm256_fmadd_pd(a, b, c);
}
ERRMAP_INLINE Pack<float, 8> MultiplyAdd(Pack<float, 8> a,
                                         Pack<float, 8> b,
                                         Pack<float, 8> c) {
  return _mm256_fmadd_ps(a, b, c);
}
#if defined(__AVX512F__)
ERRMAP_INLINE Pack<double, 8> MultiplyAdd(Pack<double, 8> a,
                                          Pack<double, 8> b,
                                          Pack<double, 8> c) {
  return _mm512_fmadd_pd(a, b, c);
}
ERRMAP_INLINE Pack<float, 16> MultiplyAdd(Pack<float, 16> a,
                                          Pack<float, 16> b,
                                          Pack<float, 16> c) {
  return _mm512_fmadd_ps(a, b, c);
}
#endif
#else
template <typename Values>
ERRMAP_INLINE Values MultiplyAdd(const Values& a,
                                 const Values& b,
                                 const Values& c) {
  return a * b + c;
}
#endif

// The larger and the smaller one of each lane; b if it is NaN. A conditional
// would be compiled to a comparison and a blend. (Masked by all ones: the
// unmasked ones start from a value that GCC 12 calls uninitialised.)
#if defined(__AVX512F__)
ERRMAP_INLINE Vec<double> Larger(Vec<double> a, Vec<double> b) {
  return _mm512_maskz_max_pd(0xFF, a, b);
}
ERRMAP_INLINE Vec<float> Larger(Vec<float> a, Vec<float> b) {
  return _mm512_maskz_max_ps(0xFFFF, a, b);
}
ERRMAP_INLINE Vec<double> Smaller(Vec<double> a, Vec<double> b) {
  return _mm512_maskz_min_pd(0xFF, a, b);
}
ERRMAP_INLINE Vec<float> Smaller(Vec<float> a, Vec<float> b) {
  return _mm512_maskz_min_ps(0xFFFF, a, b);
}
#elif defined(__AVX2__)
ERRMAP_INLINE Vec<double> Larger(Vec<double> a, Vec<double> b) {
  return _mm256_max_pd(a, b);
}
ERRMAP_INLINE Vec<float> Larger(Vec<float> a, Vec<float> b) {
  return _mm256_max_ps(a, b);
}
ERRMAP_INLINE Vec<double> Smaller(Vec<double> a, Vec<double> b) {
  return _mm256_min_pd(a, b);
}
ERRMAP_INLINE Vec<float> Smaller(Vec<float> a, Vec<float> b) {
  return _mm256_min_ps(a, b);
}
#else
template <typename Values>
ERRMAP_INLINE Values Larger(const Values& a, const Values& b) {
  return a > b ? a : b;
}
template <typename Values>
ERRMAP_INLINE Values Smaller(const Values& a, const Values& b) {
  return a < b ? a : b;
}
#endif

// Half a vector; the first half of a vector; a vector of a half and zeros.
template <typename Scalar>
using Half = Pack<Scalar, kLanes<Scalar> / 2>;

template <typename Scalar>
ERRMAP_INLINE Half<Scalar> LoadHalf(const Scalar* from) {
  Half<Scalar> v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

template <typename Scalar>
ERRMAP_INLINE void StoreHalf(const Half<Scalar>& v, Scalar* to) {
  __builtin_memcpy(to, &v, sizeof v);
}

#if defined(__AVX512F__)
ERRMAP_INLINE Half<double> FirstHalf(const Vec<double>& v) {
  return __builtin_shufflevector(v, v, 0, 1, 2, 3);
}
ERRMAP_INLINE Half<float> FirstHalf(const Vec<float>& v) {
  return __builtin_shufflevector(v, v, 0, 1, 2, 3, 4, 5, 6, 7);
}
ERRMAP_INLINE Half<double> SecondHalf(const Vec<double>& v) {
  return __builtin_shufflevector(v, v, 4, 5, 6, 7);
}
ERRMAP_INLINE Half<float> SecondHalf(const Vec<float>& v) {
  return __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15);
}
ERRMAP_INLINE Vec<double> Widened(const Half<double>& v) {
  return __builtin_shufflevector(v, Half<double>{}, 0, 1, 2, 3, 4, 5, 6, 7);
}
ERRMAP_INLINE Vec<float> Widened(const Half<float>& v) {
  return __builtin_shufflevector(
      v, Half<float>{}, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
// Both halves of a vector the same; two halves joined (under a mask of all,
// where the unmasked ones would begin with what GCC 12 calls uninitialised).
ERRMAP_INLINE Vec<double> Twice(const Half<double>& v) {
  return _mm512_maskz_broadcast_f64x4(0xFF, v);
}
ERRMAP_INLINE Vec<float> Twice(const Half<float>& v) {
  return _mm512_maskz_broadcast_f32x8(0xFFFF, v);
}
ERRMAP_INLINE Vec<double> Joined(const Half<double>& first,
                                 const Half<double>& second) {
  return _mm512_maskz_insertf64x4(0xFF, Widened(first), second, 1);
}
ERRMAP_INLINE Vec<float> Joined(const Half<float>& first,
                                const Half<float>& second) {
  return _mm512_maskz_insertf32x8(0xFFFF, Widened(first), second, 1);
}
// The first half of `first` beside the second of `second`.
ERRMAP_INLINE Vec<double> HalfOfEach(const Vec<double>& first,
                                     const Vec<double>& second) {
  return _mm512_mask_blend_pd(0xF0, first, second);
}
ERRMAP_INLINE Vec<float> HalfOfEach(const Vec<float>& first,
                                    const Vec<float>& second) {
  return _mm512_mask_blend_ps(0xFF00, first, second);
}
#endif

// Sum of the lanes: halves onto each other.
ERRMAP_INLINE double Sum(const Pack<double, 2>& v) { return v[0] + v[1]; }

ERRMAP_INLINE double Sum(const Pack<double, 4>& v) {
  const Pack<double, 2> halves =
      __builtin_shufflevector(v, v, 0, 1) + __builtin_shufflevector(v, v, 2, 3);
  return Sum(halves);
}

ERRMAP_INLINE double Sum(const Pack<double, 8>& v) {
  const Pack<double, 4> halves = __builtin_shufflevector(v, v, 0, 1, 2, 3) +
                                 __builtin_shufflevector(v, v, 4, 5, 6, 7);
  return Sum(halves);
}

ERRMAP_INLINE float Sum(const Pack<float, 4>& v) {
  return (v[0] + v[2]) + (v[1] + v[3]);
}

ERRMAP_INLINE float Sum(const Pack<float, 8>& v) {
  const Pack<float, 4> halves = __builtin_shufflevector(v, v, 0, 1, 2, 3) +
                                __builtin_shufflevector(v, v, 4, 5, 6, 7);
  return Sum(halves);
}

ERRMAP_INLINE float Sum(const Pack<float, 16>& v) {
  const Pack<float, 8> halves =
      __builtin_shufflevector(v, v, 0, 1, 2, 3, 4, 5, 6, 7) +
      __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15);
  return Sum(halves);
}

// A whole vector of a column of hidden quantities, or half a one at its end.
struct WholeVector {
  template <typename Scalar>
  static ERRMAP_INLINE Vec<Scalar> Read(const Scalar* from) {
    return Load(from);
  }
  template <typename Scalar>
  static ERRMAP_INLINE void Write(const Vec<Scalar>& v, Scalar* to) {
    Store<Scalar>(v, to);
  }
};
#if defined(__AVX512F__)
struct HalfVector {
  template <typename Scalar>
  static ERRMAP_INLINE Vec<Scalar> Read(const Scalar* from) {
    return Widened(LoadHalf(from));
  }
  template <typename Scalar>
  static ERRMAP_INLINE void Write(const Vec<Scalar>& v, Scalar* to) {
    StoreHalf<Scalar>(FirstHalf(v), to);
  }
};
#else
using HalfVector = WholeVector;  // never used
#endif

// Vectors processed side by side: one alone would wait for its own chain of
// products.
template <typename Scalar, int kCount>
struct Group {
  Vec<Scalar> v[kCount];
};

// Calls work(vector, h) along a column: WholeVector or HalfVector from row h.
template <typename Scalar, typename Work>
ERRMAP_INLINE void ForColumn(std::ptrdiff_t height, Work work) {
  std::ptrdiff_t h = 0;
  for (; h + kLanes<Scalar> <= height; h += kLanes<Scalar>) {
    work(WholeVector(), h);
  }
  if constexpr (kHasHalves) {
    if (h < height) work(HalfVector(), h);
  }
}

}  // namespace
}  // namespace errmap::models
