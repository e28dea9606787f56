#include "stats/normality/shapiro_wilk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "stats/distributions.h"

namespace errmap::stats {
namespace {

template <std::size_t kTerms>
double PolynomialOf(const std::array<double, kTerms>& coefficients, double x) {
  double value = 0.0;
  for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) {
    value = value * x + *c;
  }
  return value;
}

// Royston's fits: the two extreme weights in 1/sqrt(n), then mean and log sd
// of the transformed W in n (up to 11) or log n.
constexpr std::array<double, 6> kFirstWeight = {
    0.0, 0.221157, -0.147981, -2.071190, 4.434685, -2.706056};
constexpr std::array<double, 6> kSecondWeight = {
    0.0, 0.042981, -0.293762, -1.752461, 5.682633, -3.582633};
constexpr std::array<double, 4> kSmallMean = {
    0.5440, -0.39978, 0.025054, -0.0006714};
constexpr std::array<double, 4> kSmallLogSd = {
    1.3822, -0.77857, 0.062767, -0.0020322};
constexpr std::array<double, 4> kLargeMean = {
    -1.5861, -0.31082, -0.083751, 0.0038915};
constexpr std::array<double, 3> kLargeLogSd = {-0.4803, -0.082676, 0.0030302};
constexpr std::array<double, 2> kSmallLimit = {-2.273, 0.459};

// P(W <= w), from 1 - W.
double Probability(double one_minus_w, Index n) {
  const double size = static_cast<double>(n);
  if (n == 3) {  // exact
    const double p =
        6.0 / std::numbers::pi *
        (std::asin(std::sqrt(1.0 - one_minus_w)) - std::numbers::pi / 3.0);
    return std::clamp(p, 0.0, 1.0);
  }
  constexpr Index kLastSmall = 11;
  double y = std::log(one_minus_w);
  double mean = 0.0;
  double sd = 0.0;
  if (n <= kLastSmall) {
    const double limit = PolynomialOf(kSmallLimit, size);
    if (y >= limit) return 0.0;
    y = -std::log(limit - y);
    mean = PolynomialOf(kSmallMean, size);
    sd = std::exp(PolynomialOf(kSmallLogSd, size));
  } else {
    const double log_size = std::log(size);
    mean = PolynomialOf(kLargeMean, log_size);
    sd = std::exp(PolynomialOf(kLargeLogSd, log_size));
  }
  return NormalCdf((mean - y) / sd);
}

}  // namespace

ShapiroWilkTest::ShapiroWilkTest(Index n) : n_(n) {
  if (n < kFewest || n > kMost) return;
  const Index half = n / 2;
  upper_weights_.resize(half);
  if (n == 3) {
    upper_weights_[0] = std::numbers::sqrt2 / 2.0;
    return;
  }
  const double size = static_cast<double>(n);
  // Blom's approximation of the expected normal order statistics, from above.
  VectorXd& m = upper_weights_;
  for (Index i = 0; i < half; ++i) {
    m[i] =
        -NormalQuantile((static_cast<double>(i + 1) - 0.375) / (size + 0.25));
  }
  const double squares = 2.0 * m.squaredNorm();
  const double norm = std::sqrt(squares);
  const double inverse_root = 1.0 / std::sqrt(size);
  const double first = PolynomialOf(kFirstWeight, inverse_root) + m[0] / norm;
  constexpr Index kLastWithOneFit = 5;
  if (n <= kLastWithOneFit) {
    const double scale =
        std::sqrt((squares - 2.0 * m[0] * m[0]) / (1.0 - 2.0 * first * first));
    m /= scale;
    m[0] = first;
    return;
  }
  const double second = PolynomialOf(kSecondWeight, inverse_root) + m[1] / norm;
  const double scale =
      std::sqrt((squares - 2.0 * (m[0] * m[0] + m[1] * m[1])) /
                (1.0 - 2.0 * (first * first + second * second)));
  m /= scale;
  m[0] = first;
  m[1] = second;
}

TestResult ShapiroWilkTest::operator()(const OrderedSample& sample) const {
  if (sample.size() != n_) {
    throw std::invalid_argument("ShapiroWilkTest: made for " +
                                std::to_string(n_) + " values, found " +
                                std::to_string(sample.size()));
  }
  const std::string why_not = sample.WhyNotWith(kFewest);
  if (!why_not.empty()) return NotApplicable(why_not);
  if (n_ > kMost) {
    return NotApplicable("calibrated up to 5000 values, found " +
                         std::to_string(n_));
  }
  const VectorXd& x = sample.z();
  const Index half = n_ / 2;
  // W is the squared correlation of x with the weights; 1 - W as (a - b)(a + b)
  // keeps its digits where W is close to 1.
  const VectorXd spread = x.tail(half).reverse() - x.head(half);
  const double weight_squares = 2.0 * upper_weights_.squaredNorm();
  const double squares = (x.array() - x.mean()).square().sum();
  const double products = upper_weights_.dot(spread);
  const double root = std::sqrt(weight_squares * squares);
  const double one_minus_w = std::max(
      0.0, (root - products) * (root + products) / (weight_squares * squares));
  return {.statistic = 1.0 - one_minus_w, .p = Probability(one_minus_w, n_)};
}

}  // namespace errmap::stats
