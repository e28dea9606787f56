#include "stats/normality/lilliefors.h"

#include <algorithm>
#include <cmath>

#include "stats/kolmogorov_smirnov.h"
#include "stats/normality/simulated_quantiles.h"
#include "stats/not_a_number.h"

namespace errmap::stats {
namespace {

using Eigen::Index;

double Polynomial(double x, double a, double b, double c, double d, double e) {
  return a + x * (b + x * (c + x * (d + x * e)));
}

}  // namespace

TestResult Lilliefors(const OrderedSample& sample) {
  const std::string why_not = sample.WhyNotWith(kFewestSimulated);
  if (!why_not.empty()) return NotApplicable(why_not);
  const double d = KsDistanceFromStandardNormal(sample.z());
  return {.statistic = d, .p = LillieforsProbability(d, sample.size())};
}

double LillieforsProbability(double d, Index n) {
  const double p = SimulatedProbability(SimulatedStatistic::kLilliefors, d, n);
  constexpr Index kFewestForFormula = 5;
  if (p > kSmallestSimulated || n < kFewestForFormula) return p;
  return std::min(p, DallalWilkinsonProbability(d, n));
}

double DallalWilkinsonProbability(double d, Index n) {
  constexpr Index kFewest = 5;
  if (n < kFewest || std::isnan(d)) {
    return kNaN;
  }
  // Eq. 2 of the paper, n above 100 brought back to 100.
  constexpr double kLargestSize = 100.0;
  constexpr double kValidTo = 0.1;
  const double size = static_cast<double>(n);
  const double scaled =
      size > kLargestSize ? d * std::pow(size / kLargestSize, 0.49) : d;
  const double base = std::min(size, kLargestSize);
  const double p =
      std::exp(-7.01256 * scaled * scaled * (base + 2.78019) +
               2.99587 * scaled * std::sqrt(base + 2.78019) - 0.122119 +
               0.974598 / std::sqrt(base) + 1.67997 / base);
  if (p <= kValidTo) return p;
  const double k = (std::sqrt(size) - 0.01 + 0.85 / std::sqrt(size)) * d;
  if (k <= 0.302) return 1.0;
  if (k <= 0.5) {
    return Polynomial(k, 2.76773, -19.828315, 80.709644, -138.55152, 81.218052);
  }
  if (k <= 0.9) {
    return Polynomial(
        k, -4.901232, 40.662806, -97.490286, 94.029866, -32.355711);
  }
  if (k <= 1.31) {
    return Polynomial(k, 6.198765, -19.558097, 23.186922, -12.234627, 2.423045);
  }
  return 0.0;
}

}  // namespace errmap::stats
