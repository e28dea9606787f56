#pragma once

// The code behind models/net/net_kernels.h. Each net_kernels_<version>.cc
// compiles it with compiler options of its own, so whatever stands here must be
// local to that file or inlined: the linker might else take a function of the
// fastest version for the whole program. Hence no standard library and no
// Eigen. Those with instructions of their own include <immintrin.h> before it.

#include <cstddef>
#include <cstdint>

#include "models/net/net_kernels.h"

#define ERRMAP_INLINE __attribute__((always_inline)) inline
#define ERRMAP_INLINED __attribute__((always_inline))  // of a lambda

namespace errmap::models {
namespace {

// The width of this version's vectors; wider ones would be cut up, badly.
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
// Whether a height may end in half a vector.
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

// a b + c, rounded once where the machine can: asked for here, since the
// compiler may not contract products and sums by itself (-ffp-contract=off).
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

// Half a vector; a vector's first one; a vector of one and zeros.
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
ERRMAP_INLINE Vec<double> Widened(const Half<double>& v) {
  return __builtin_shufflevector(v, Half<double>{}, 0, 1, 2, 3, 4, 5, 6, 7);
}
ERRMAP_INLINE Vec<float> Widened(const Half<float>& v) {
  return __builtin_shufflevector(
      v, Half<float>{}, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
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

// 2^r = 1 + r q(r) on [-1/2, 1/2]: q interpolates at Chebyshev nodes, worked
// out in 50 digits, to 1.3e-17 and 7.8e-9. Adding kShift rounds u to a whole
// number k whose biased exponent then stands in the lowest bits.
template <typename Scalar>
struct PowerOfTwo;
template <>
struct PowerOfTwo<double> {
  static constexpr int kDegree = 10;
  static constexpr double kQ[kDegree + 1] = {0.69314718055994530942,
                                             0.2402265069591009822,
                                             0.055504108664821594339,
                                             0.0096181291076068885273,
                                             0.001333355814641693531,
                                             0.00015403530441736050155,
                                             0.000015252733829836118394,
                                             1.3215442587921689653e-6,
                                             1.0178062445845773521e-7,
                                             7.0725859492692236999e-9,
                                             4.4549605981865183938e-10};
  static constexpr double kShift = 6755399441055744.0 + 1023.0;  // 1.5 * 2^52
  static constexpr double kLeast = -1022.0;
  static constexpr double kMost = 1023.0;
  static constexpr int kMantissa = 52;
};
template <>
struct PowerOfTwo<float> {
  static constexpr int kDegree = 5;
  static constexpr float kQ[kDegree + 1] = {0.693147188026F,
                                            0.240226507606F,
                                            0.0555035711422F,
                                            0.00961808255728F,
                                            0.00133908633647F,
                                            0.000154531629451F};
  static constexpr float kShift = 12582912.0F + 127.0F;  // 1.5 * 2^23
  static constexpr float kLeast = -126.0F;
  static constexpr float kMost = 127.0F;
  static constexpr int kMantissa = 23;
};

// A whole vector of a column of hidden quantities, or the half one at its end.
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

// Vectors worked on side by side: one alone waits for its own chain of
// products.
template <typename Scalar, int kCount>
struct Group {
  Vec<Scalar> v[kCount];
};

// 1 / (1 + 2^u), u = -s log2(e) held where 2^u is a normal number. A
// comparison with NaN is false, so that NaN goes through.
template <typename Scalar, int kCount>
ERRMAP_INLINE void ApplyLogistic(Group<Scalar, kCount>* s) {
  using Power = PowerOfTwo<Scalar>;
  using Bits = typename VectorTypes<Scalar>::Bits;
  constexpr auto kLog2E = static_cast<Scalar>(1.44269504088896340736);
  const Vec<Scalar> zero = {};
  const Vec<Scalar> one = zero + Scalar(1);
  Group<Scalar, kCount> shifted;
  Group<Scalar, kCount> r;
  Group<Scalar, kCount> q;
#pragma GCC unroll 4
  for (int i = 0; i < kCount; ++i) {
    Vec<Scalar> u = s->v[i] * -kLog2E;
    u = u < Power::kLeast ? zero + Power::kLeast : u;
    u = u > Power::kMost ? zero + Power::kMost : u;
    shifted.v[i] = u + Power::kShift;
    r.v[i] = u - (shifted.v[i] - Power::kShift);
    q.v[i] = zero + Power::kQ[Power::kDegree];
  }
#pragma GCC unroll 16
  for (int k = Power::kDegree - 1; k >= 0; --k) {
#pragma GCC unroll 4
    for (int i = 0; i < kCount; ++i) {
      q.v[i] = MultiplyAdd(q.v[i], r.v[i], zero + Power::kQ[k]);
    }
  }
#pragma GCC unroll 4
  for (int i = 0; i < kCount; ++i) {
    Bits exponent;
    __builtin_memcpy(&exponent, &shifted.v[i], sizeof exponent);
    exponent <<= Power::kMantissa;
    Vec<Scalar> power;
    __builtin_memcpy(&power, &exponent, sizeof power);
    const Vec<Scalar> mantissa = MultiplyAdd(q.v[i], r.v[i], one);
    s->v[i] = one / MultiplyAdd(mantissa, power, one);
  }
}

template <typename Scalar,
          bool kAlong,
          int kCount,
          typename Vector = WholeVector>
ERRMAP_INLINE void LogisticGroup(
    const Scalar* s, const Scalar* t, Scalar a, Scalar* s_new, Scalar* y) {
  Group<Scalar, kCount> group;
#pragma GCC unroll 4
  for (int i = 0; i < kCount; ++i) {
    group.v[i] = Vector::Read(s + i * kLanes<Scalar>);
    if constexpr (kAlong) {
      group.v[i] = MultiplyAdd(
          Vec<Scalar>{} + a, Vector::Read(t + i * kLanes<Scalar>), group.v[i]);
      Vector::Write(group.v[i], s_new + i * kLanes<Scalar>);
    }
  }
  ApplyLogistic(&group);
#pragma GCC unroll 4
  for (int i = 0; i < kCount; ++i) {
    Vector::Write(group.v[i], y + i * kLanes<Scalar>);
  }
}

// n a multiple of the lanes, or of half of them where heights may be. Where
// kAlong, s_new = s + a t comes first.
template <typename Scalar, bool kAlong>
ERRMAP_INLINE void LogisticOfVectors(std::ptrdiff_t n,
                                     const Scalar* s,
                                     const Scalar* t,
                                     Scalar a,
                                     Scalar* s_new,
                                     Scalar* y) {
  constexpr int kTogether = 4;
  constexpr std::ptrdiff_t kStep = kTogether * kLanes<Scalar>;
  std::ptrdiff_t i = 0;
  for (; i + kStep <= n; i += kStep) {
    LogisticGroup<Scalar, kAlong, kTogether>(s + i,
                                             kAlong ? t + i : nullptr,
                                             a,
                                             kAlong ? s_new + i : nullptr,
                                             y + i);
  }
  for (; i + kLanes<Scalar> <= n; i += kLanes<Scalar>) {
    LogisticGroup<Scalar, kAlong, 1>(s + i,
                                     kAlong ? t + i : nullptr,
                                     a,
                                     kAlong ? s_new + i : nullptr,
                                     y + i);
  }
  if constexpr (kHasHalves) {
    if (i == n) return;
    LogisticGroup<Scalar, kAlong, 1, HalfVector>(s + i,
                                                 kAlong ? t + i : nullptr,
                                                 a,
                                                 kAlong ? s_new + i : nullptr,
                                                 y + i);
  }
}

// work(vector, h) over a column: WholeVector or HalfVector from row h on.
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

template <typename Scalar>
void Logistic(std::ptrdiff_t n, const Scalar* s, Scalar* y) {
  const std::ptrdiff_t whole = n / kLanes<Scalar> * kLanes<Scalar>;
  LogisticOfVectors<Scalar, false>(whole, s, nullptr, Scalar(0), nullptr, y);
  if (whole == n) return;
  Scalar rest[kLanes<Scalar>] = {};
  for (std::ptrdiff_t i = whole; i < n; ++i) rest[i - whole] = s[i];
  LogisticGroup<Scalar, false, 1>(rest, nullptr, Scalar(0), nullptr, rest);
  for (std::ptrdiff_t i = whole; i < n; ++i) y[i] = rest[i - whole];
}

// Some columns at a time, so that their y are still in the first-level cache
// for the sums.
template <typename Scalar, bool kAlong>
ERRMAP_INLINE void ForwardTiles(BlockSize size,
                                const Scalar* s,
                                const Scalar* t,
                                Scalar a,
                                const Scalar* w2,
                                Scalar* s_new,
                                Scalar* y,
                                Scalar* o) {
  constexpr std::ptrdiff_t kTile = 1024;
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
                                      kAlong ? s_new + first : nullptr,
                                      y + first);
    for (std::ptrdiff_t column = begin; column < end; ++column) {
      for (std::ptrdiff_t j = 0; j < size.outputs; ++j) {
        Vec<Scalar> sum = {};
        ForColumn<Scalar>(
            height, [&](auto vector, std::ptrdiff_t h) ERRMAP_INLINED {
              sum = MultiplyAdd(vector.Read(w2 + j * height + h),
                                vector.Read(y + column * height + h),
                                sum);
            });
        o[column * size.outputs + j] = Sum(sum);
      }
    }
  }
}

template <typename Scalar>
void Forward(
    BlockSize size, const Scalar* s, const Scalar* w2, Scalar* y, Scalar* o) {
  ForwardTiles<Scalar, false>(size, s, nullptr, Scalar(0), w2, nullptr, y, o);
}

template <typename Scalar>
void ForwardAlong(BlockSize size,
                  const Scalar* s,
                  const Scalar* t,
                  Scalar a,
                  const Scalar* w2,
                  Scalar* s_new,
                  Scalar* y,
                  Scalar* o) {
  ForwardTiles<Scalar, true>(size, s, t, a, w2, s_new, y, o);
}

template <typename Scalar>
void BendAlong(BlockSize size,
               const Scalar* y,
               const Scalar* t,
               const Scalar* w2,
               const Scalar* p2,
               Scalar* first,
               Scalar* second) {
  const std::ptrdiff_t height = size.height;
  const Vec<Scalar> one = Vec<Scalar>{} + Scalar(1);
  for (std::ptrdiff_t column = 0; column < size.columns; ++column) {
    const Scalar* values = y + column * height;
    const Scalar* along = t + column * height;
    for (std::ptrdiff_t j = 0; j < size.outputs; ++j) {
      Vec<Scalar> sum1 = {};
      Vec<Scalar> sum2 = {};
      ForColumn<Scalar>(
          height, [&](auto vector, std::ptrdiff_t h) ERRMAP_INLINED {
            const Vec<Scalar> value = vector.Read(values + h);
            const Vec<Scalar> step = vector.Read(along + h);
            const Vec<Scalar> w = vector.Read(w2 + j * height + h);
            const Vec<Scalar> p = vector.Read(p2 + j * height + h);
            // y' = y (1 - y) t and y'' = y' (1 - 2 y) t.
            const Vec<Scalar> slope = MultiplyAdd(-value, value, value) * step;
            const Vec<Scalar> bend = (one - (value + value)) * step;
            sum1 = MultiplyAdd(p, value, sum1);
            sum1 = MultiplyAdd(w, slope, sum1);
            sum2 = MultiplyAdd(slope, MultiplyAdd(w, bend, p + p), sum2);
          });
      first[column * size.outputs + j] = Sum(sum1);
      second[column * size.outputs + j] = Sum(sum2);
    }
  }
}

// kCount vectors from row h on of all columns, of one output: their sums stay
// in registers.
template <typename Scalar, int kCount, typename Vector = WholeVector>
ERRMAP_INLINE void BackwardRows(BlockSize size,
                                std::ptrdiff_t h,
                                const Scalar* y,
                                const Scalar* w2,
                                const Scalar* d_output,
                                Scalar* delta,
                                Scalar* d_w2) {
  Group<Scalar, kCount> w;
  Group<Scalar, kCount> sum;
#pragma GCC unroll 4
  for (int i = 0; i < kCount; ++i) {
    w.v[i] = Vector::Read(w2 + h + i * kLanes<Scalar>);
    sum.v[i] = Vector::Read(d_w2 + h + i * kLanes<Scalar>);
  }
  for (std::ptrdiff_t column = 0; column < size.columns; ++column) {
    const std::ptrdiff_t begin = column * size.height + h;
    const Vec<Scalar> by_output = Repeated<Vec<Scalar>>(d_output[column]);
#pragma GCC unroll 4
    for (int i = 0; i < kCount; ++i) {
      const Vec<Scalar> value = Vector::Read(y + begin + i * kLanes<Scalar>);
      sum.v[i] = MultiplyAdd(value, by_output, sum.v[i]);
      Vector::Write(w.v[i] * by_output * MultiplyAdd(-value, value, value),
                    delta + begin + i * kLanes<Scalar>);
    }
  }
#pragma GCC unroll 4
  for (int i = 0; i < kCount; ++i) {
    Vector::Write(sum.v[i], d_w2 + h + i * kLanes<Scalar>);
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
    BackwardRows<Scalar, kTogether>(size, h, y, w2, d_output, delta, d_w2);
  }
  for (; h + kLanes<Scalar> <= size.height; h += kLanes<Scalar>) {
    BackwardRows<Scalar, 1>(size, h, y, w2, d_output, delta, d_w2);
  }
  if constexpr (kHasHalves) {
    if (h == size.height) return;
    BackwardRows<Scalar, 1, HalfVector>(size, h, y, w2, d_output, delta, d_w2);
  }
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

// Products. A tile of the result, `kTall` vectors by `kWide` columns, stays in
// registers while the inner dimension goes by, and nothing is packed: what nets
// have is small enough for the first-level cache as it lies.

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
// element (k, j) of b stands at b + k inner_b + j column_b, column j of c
// begins at c + j stride_c.
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

// kTall vectors, and half a one below them where kHalf.
template <typename Scalar, bool kAdd, int kTall, bool kHalf, int kWide>
ERRMAP_INLINE void MultiplyTile(const Factors<Scalar>& f,
                                std::ptrdiff_t row,
                                std::ptrdiff_t column) {
  constexpr std::ptrdiff_t kWhole = kTall * kLanes<Scalar>;
  const Scalar* a = f.a + row;
  const Scalar* b = f.b + column * f.column_b;
  Scalar* c = f.c + column * f.stride_c + row;
  Group<Scalar, (kTall > 0 ? kTall : 1)> sums[kWide];
  Half<Scalar> halves[kWide];
#pragma GCC unroll 12
  for (int j = 0; j < kWide; ++j) {
#pragma GCC unroll 4
    for (int i = 0; i < kTall; ++i) {
      sums[j].v[i] =
          kAdd ? Load(c + j * f.stride_c + i * kLanes<Scalar>) : Vec<Scalar>{};
    }
    if constexpr (kHalf) {
      halves[j] = kAdd ? LoadHalf(c + j * f.stride_c + kWhole) : Half<Scalar>{};
    }
  }
  for (std::ptrdiff_t k = 0; k < f.inner; ++k) {
    Group<Scalar, (kTall > 0 ? kTall : 1)> left;
    Half<Scalar> left_half;
#pragma GCC unroll 4
    for (int i = 0; i < kTall; ++i) {
      left.v[i] = Load(a + k * f.stride_a + i * kLanes<Scalar>);
    }
    if constexpr (kHalf) left_half = LoadHalf(a + k * f.stride_a + kWhole);
#pragma GCC unroll 12
    for (int j = 0; j < kWide; ++j) {
      const Scalar value = b[k * f.inner_b + j * f.column_b];
      const Vec<Scalar> right = Repeated<Vec<Scalar>>(value);
#pragma GCC unroll 4
      for (int i = 0; i < kTall; ++i) {
        sums[j].v[i] = MultiplyAdd(left.v[i], right, sums[j].v[i]);
      }
      if constexpr (kHalf) {
        halves[j] = MultiplyAdd(left_half, FirstHalf(right), halves[j]);
      }
    }
  }
#pragma GCC unroll 12
  for (int j = 0; j < kWide; ++j) {
#pragma GCC unroll 4
    for (int i = 0; i < kTall; ++i) {
      Store<Scalar>(sums[j].v[i], c + j * f.stride_c + i * kLanes<Scalar>);
    }
    if constexpr (kHalf) {
      StoreHalf<Scalar>(halves[j], c + j * f.stride_c + kWhole);
    }
  }
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

// The rows from `row` on that kTall vectors hold, and a half one.
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

// The last `rest` vectors, fewer than kTallest, and a half one.
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
                 Scalar* d_w1) {
  MultiplyAll<Scalar, true>(
      {size.columns, delta, size.height, x, inner, 1, d_w1, size.height},
      size.height,
      inner);
}

template <typename Scalar>
constexpr NetKernels<Scalar> MakeNetKernels(const char* name) {
  return {name,
          Activate<Scalar>,
          AddProducts<Scalar>,
          Logistic<Scalar>,
          Forward<Scalar>,
          ForwardAlong<Scalar>,
          BendAlong<Scalar>,
          Backward<Scalar>};
}

}  // namespace
}  // namespace errmap::models

#undef ERRMAP_INLINED
#undef ERRMAP_INLINE
