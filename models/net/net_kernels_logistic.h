#pragma once

// The logistic function of many values: a part of net_kernels_body.h.

#include <cstddef>

#include "models/net/net_kernels_vectors.h"

namespace errmap::models {
namespace {

// 2^r = 1 + r q(r) on [-1/2, 1/2]. q interpolates at Chebyshev nodes, computed
// in 50 digits, to 1.3e-17 and 7.8e-9. Adding kShift rounds u to a whole number
// k and puts its biased exponent into the lowest bits.
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

// Vectors side by side, as many as the registers hold: each alone would wait
// for its own chain of products.
#if defined(__AVX512F__)
constexpr int kLogistics = 6;
#else
constexpr int kLogistics = 4;
#endif

// 1 / (1 + 2^u), u = -s log2(e) clamped so that 2^u is a normal number. NaN
// stays NaN.
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
#pragma GCC unroll 6
  for (int i = 0; i < kCount; ++i) {
    Vec<Scalar> u = s->v[i] * -kLog2E;
    u = Larger(zero + Power::kLeast, u);
    u = Smaller(zero + Power::kMost, u);
    shifted.v[i] = u + Power::kShift;
    r.v[i] = u - (shifted.v[i] - Power::kShift);
    q.v[i] = zero + Power::kQ[Power::kDegree];
  }
#pragma GCC unroll 16
  for (int k = Power::kDegree - 1; k >= 0; --k) {
#pragma GCC unroll 6
    for (int i = 0; i < kCount; ++i) {
      q.v[i] = MultiplyAdd(q.v[i], r.v[i], zero + Power::kQ[k]);
    }
  }
#pragma GCC unroll 6
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
ERRMAP_INLINE void LogisticGroup(const Scalar* s,
                                 const Scalar* t,
                                 Scalar a,
                                 Scalar* y) {
  Group<Scalar, kCount> group;
#pragma GCC unroll 6
  for (int i = 0; i < kCount; ++i) {
    group.v[i] = Vector::Read(s + i * kLanes<Scalar>);
    if constexpr (kAlong) {
      group.v[i] = MultiplyAdd(
          Vec<Scalar>{} + a, Vector::Read(t + i * kLanes<Scalar>), group.v[i]);
    }
  }
  ApplyLogistic(&group);
#pragma GCC unroll 6
  for (int i = 0; i < kCount; ++i) {
    Vector::Write(group.v[i], y + i * kLanes<Scalar>);
  }
}

// n is a multiple of the lanes, or of half of them if heights may be. If
// kAlong, computes the function of s + a t.
template <typename Scalar, bool kAlong>
ERRMAP_INLINE void LogisticOfVectors(
    std::ptrdiff_t n, const Scalar* s, const Scalar* t, Scalar a, Scalar* y) {
  constexpr std::ptrdiff_t kStep = kLogistics * kLanes<Scalar>;
  std::ptrdiff_t i = 0;
  for (; i + kStep <= n; i += kStep) {
    LogisticGroup<Scalar, kAlong, kLogistics>(
        s + i, kAlong ? t + i : nullptr, a, y + i);
  }
  for (; i + kLanes<Scalar> <= n; i += kLanes<Scalar>) {
    LogisticGroup<Scalar, kAlong, 1>(s + i, kAlong ? t + i : nullptr, a, y + i);
  }
  if constexpr (kHasHalves) {
    if (i == n) return;
    LogisticGroup<Scalar, kAlong, 1, HalfVector>(
        s + i, kAlong ? t + i : nullptr, a, y + i);
  }
}

template <typename Scalar>
void Logistic(std::ptrdiff_t n, const Scalar* s, Scalar* y) {
  const std::ptrdiff_t whole = n / kLanes<Scalar> * kLanes<Scalar>;
  LogisticOfVectors<Scalar, false>(whole, s, nullptr, Scalar(0), y);
  if (whole == n) return;
  Scalar rest[kLanes<Scalar>] = {};
  for (std::ptrdiff_t i = whole; i < n; ++i) rest[i - whole] = s[i];
  LogisticGroup<Scalar, false, 1>(rest, nullptr, Scalar(0), rest);
  for (std::ptrdiff_t i = whole; i < n; ++i) y[i] = rest[i - whole];
}

}  // namespace
}  // namespace errmap::models
