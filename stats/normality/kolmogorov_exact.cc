#include "stats/normality/kolmogorov_exact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stats/distributions.h"
#include "stats/require.h"

namespace errmap::stats {
namespace {

// P(D+ >= d) = d sum_j C(n, j) (d + j/n)^(j-1) (1 - d - j/n)^(n-j), the sum
// over j = 0 .. floor(n (1 - d)) (Smirnov 1944; Birnbaum & Tingey 1951).
double OneSidedTail(double d, Index n) {
  const auto size = static_cast<long double>(n);
  const auto distance = static_cast<long double>(d);
  long double sum = 0.0L;
  long double log_choose = 0.0L;
  for (Index j = 0; j < n; ++j) {
    const auto count = static_cast<long double>(j);
    const long double reached = distance + count / size;
    if (reached >= 1.0L) break;
    sum += std::exp(log_choose + (count - 1.0L) * std::log(reached) +
                    (size - count) * std::log1p(-reached));
    log_choose += std::log((size - count) / (count + 1.0L));
  }
  return static_cast<double>(distance * sum);
}

// P(D < d) by the Durbin matrix H: n!/n^n (H^n)_kk.
double BodyByDurbinMatrix(double d, Index n) {
  const double size = static_cast<double>(n);
  const auto k = static_cast<Index>(std::floor(size * d)) + 1;
  const Index m = 2 * k - 1;
  // k - n d with one rounding: h next to 1 or 0 decides the far tail.
  const double h = std::fma(-size, d, static_cast<double>(k));
  // 1/t!, as far as it can matter beside the terms of t = 0 and 1.
  const Index band = std::min<Index>(m, 26);
  VectorXd inverse_factorial(m + 1);
  VectorXd h_power(m + 1);  // h^t / t!
  inverse_factorial[0] = h_power[0] = 1.0;
  for (Index t = 1; t <= m; ++t) {
    inverse_factorial[t] = inverse_factorial[t - 1] / static_cast<double>(t);
    h_power[t] = h_power[t - 1] * h / static_cast<double>(t);
  }
  const double corner = 2.0 * h > 1.0
                            ? std::pow(2.0 * h - 1.0, static_cast<double>(m)) *
                                  inverse_factorial[m]
                            : 0.0;
  // About 1/e, so that the vector keeps its size; exact in binary, so that n
  // factors add no error that the last line would not take back.
  constexpr double kScale = 377.0 / 1024.0;
  constexpr double kVanished = 1e-280;
  VectorXd v = VectorXd::Zero(m);
  VectorXd next(m);
  v[k - 1] = 1.0;
  for (Index step = 0; step < n; ++step) {
    // Row i of H holds 1/(i - j + 1)! in column j <= i + 1: a convolution.
    next.setZero();
    for (Index t = 0; t <= band; ++t) {
      const Index length = t == 0 ? m - 1 : m - t + 1;
      const Index to = t == 0 ? 0 : t - 1;
      next.segment(to, length) +=
          inverse_factorial[t] * v.segment(t == 0 ? 1 : 0, length);
    }
    next -= v[0] * h_power.tail(m);
    next[m - 1] -= h_power.tail(m).reverse().dot(v);
    next[m - 1] += corner * v[0];
    v = kScale * next;
    if (v.maxCoeff() < kVanished) return 0.0;
  }
  const auto long_size = static_cast<long double>(n);
  const long double log_factor =
      LogFactorial(n) -
      long_size * std::log(long_size * static_cast<long double>(kScale));
  return static_cast<double>(static_cast<long double>(v[k - 1]) *
                             std::exp(log_factor));
}

// P(D < d) by Pelz & Good's expansion K0 + K1/sqrt(n) + K2/n + K3/n^(3/2).
double BodyByExpansion(double d, Index n) {
  const double root = std::sqrt(static_cast<double>(n));
  const double z = root * d;
  const double z2 = z * z;
  const double z4 = z2 * z2;
  const double z6 = z4 * z2;
  const double pi2 = std::numbers::pi * std::numbers::pi;
  const double pi4 = pi2 * pi2;
  const double pi6 = pi4 * pi2;
  double k0 = 0.0;
  double k1 = 0.0;
  double k2 = 0.0;
  double k3 = 0.0;
  double k2_whole = 0.0;
  double k3_whole = 0.0;
  constexpr int kTerms = 12;  // z < sqrt(5): exp(-12^2 pi^2 / 10) vanishes
  for (int j = 0; j < kTerms; ++j) {
    const double a2 = (j + 0.5) * (j + 0.5);
    const double a4 = a2 * a2;
    const double half = std::exp(-pi2 * a2 / (2.0 * z2));
    k0 += half;
    k1 += (pi2 * a2 - z2) * half;
    k2 += (6.0 * z6 + 2.0 * z4 + pi2 * (2.0 * z4 - 5.0 * z2) * a2 +
           pi4 * (1.0 - 2.0 * z2) * a4) *
          half;
    k3 += (pi6 * a4 * a2 * (5.0 - 30.0 * z2) +
           pi4 * a4 * (-60.0 * z2 + 212.0 * z4) +
           pi2 * a2 * (135.0 * z4 - 96.0 * z6) - 30.0 * z6 - 90.0 * z6 * z2) *
          half;
    const double b2 = static_cast<double>(j) * j;
    const double whole = std::exp(-pi2 * b2 / (2.0 * z2));
    k2_whole += pi2 * b2 * whole;
    k3_whole += (3.0 * pi2 * b2 * z2 - pi4 * b2 * b2) * whole;
  }
  // Each sum runs over both signs, hence twice what was added up.
  const double unit = 2.0 * std::sqrt(0.5 * std::numbers::pi);
  const double first = unit * k0 / z;
  const double second = unit * k1 / (6.0 * z4);
  const double third =
      unit * (k2 / (72.0 * z6 * z) - k2_whole / (36.0 * z2 * z));
  const double fourth =
      unit * (k3 / (6480.0 * z6 * z4) + k3_whole / (216.0 * z6));
  return first + (second + (third + fourth / root) / root) / root;
}

}  // namespace

double KsProbabilityExact(double d, Index n) {
  Require(n >= 1, "KsProbabilityExact: needs at least 1 value", n);
  if (std::isnan(d)) return d;
  const double size = static_cast<double>(n);
  if (d >= 1.0) return 0.0;
  if (size * d <= 0.5) return 1.0;
  constexpr double kTailFrom = 5.0;
  if (d >= 0.5 || size * d * d >= kTailFrom) return 2.0 * OneSidedTail(d, n);
  const double body =
      n <= kMostForExactKs ? BodyByDurbinMatrix(d, n) : BodyByExpansion(d, n);
  return std::clamp(1.0 - body, 0.0, 1.0);
}

}  // namespace errmap::stats
