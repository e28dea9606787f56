#include "stats/kolmogorov_smirnov.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stats/distributions.h"
#include "stats/not_a_number.h"

namespace errmap::stats {

double KsDistanceFromNormal(const Eigen::Ref<const VectorXd>& sample,
                            double mean,
                            double sd) {
  const Index n = sample.size();
  if (n == 0 || !(sd > 0.0)) return kNaN;
  VectorXd sorted = (sample.array() - mean) / sd;
  // A NaN has no place in an order.
  if (sorted.hasNaN()) return kNaN;
  std::sort(sorted.begin(), sorted.end());
  return KsDistanceFromStandardNormal(sorted);
}

double KsDistanceFromStandardNormal(
    const Eigen::Ref<const VectorXd>& ascending) {
  const Index n = ascending.size();
  double distance = 0.0;
  for (Index i = 0; i < n; ++i) {
    const double cdf = NormalCdf(ascending[i]);
    const double below = static_cast<double>(i) / static_cast<double>(n);
    const double above = static_cast<double>(i + 1) / static_cast<double>(n);
    distance = std::max({distance, cdf - below, above - cdf});
  }
  return distance;
}

double KsProbabilityMeanSdGiven(double d, Index n) {
  return KolmogorovComplement(std::sqrt(static_cast<double>(n)) * d);
}

double KolmogorovComplement(double lambda) {
  if (std::isnan(lambda)) return lambda;
  if (lambda <= 0.0) return 1.0;
  // The two forms are equally fast here, where each term falls steeply.
  constexpr double kCrossover = 1.0;
  if (lambda < kCrossover) {
    // 1 - sqrt(2 pi)/lambda sum_k exp(-(2k-1)^2 pi^2 / (8 lambda^2)).
    const double exponent =
        -std::numbers::pi * std::numbers::pi / (8.0 * lambda * lambda);
    double sum = 0.0;
    for (int k = 1; k <= 9; k += 2) sum += std::exp(exponent * k * k);
    return 1.0 - std::sqrt(2.0 * std::numbers::pi) / lambda * sum;
  }
  double sum = 0.0;
  double sign = 1.0;
  for (int j = 1; j <= 8; ++j) {
    sum += sign * std::exp(-2.0 * j * j * lambda * lambda);
    sign = -sign;
  }
  return std::clamp(2.0 * sum, 0.0, 1.0);
}

}  // namespace errmap::stats
