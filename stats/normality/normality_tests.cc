#include "stats/normality/normality_tests.h"

#include <cmath>

#include "stats/distributions.h"

namespace errmap::stats {
namespace {

double AndersonDarlingProbability(double a2, double n) {
  const double a = a2 * (1.0 + 0.75 / n + 2.25 / (n * n));
  constexpr double kLast = 10.0;  // the last quadratic turns up again later
  constexpr double kLeast = 3.7e-24;
  if (a < 0.2) return -std::expm1(-13.436 + 101.14 * a - 223.73 * a * a);
  if (a < 0.34) return -std::expm1(-8.318 + 42.796 * a - 59.938 * a * a);
  if (a < 0.6) return std::exp(0.9177 - 4.279 * a - 1.38 * a * a);
  if (a < kLast) return std::exp(1.2937 - 5.709 * a + 0.0186 * a * a);
  return kLeast;
}

// D'Agostino (1970), with the variance ratio of its Eq. 13.
double SkewnessScore(double skewness, double n) {
  const double y =
      skewness * std::sqrt((n + 1.0) * (n + 3.0) / (6.0 * (n - 2.0)));
  const double beta2 = 3.0 * (n * n + 27.0 * n - 70.0) * (n + 1.0) * (n + 3.0) /
                       ((n - 2.0) * (n + 5.0) * (n + 7.0) * (n + 9.0));
  const double w2 = -1.0 + std::sqrt(2.0 * (beta2 - 1.0));
  const double delta = 1.0 / std::sqrt(0.5 * std::log(w2));
  const double alpha = std::sqrt(2.0 / (w2 - 1.0));
  return delta * std::asinh(y / alpha);
}

// Anscombe & Glynn (1983).
double KurtosisScore(double kurtosis, double n) {
  const double mean = 3.0 * (n - 1.0) / (n + 1.0);
  const double variance = 24.0 * n * (n - 2.0) * (n - 3.0) /
                          ((n + 1.0) * (n + 1.0) * (n + 3.0) * (n + 5.0));
  const double x = (kurtosis - mean) / std::sqrt(variance);
  const double root_beta1 =
      6.0 * (n * n - 5.0 * n + 2.0) / ((n + 7.0) * (n + 9.0)) *
      std::sqrt(6.0 * (n + 3.0) * (n + 5.0) / (n * (n - 2.0) * (n - 3.0)));
  const double a = 6.0 + 8.0 / root_beta1 *
                             (2.0 / root_beta1 +
                              std::sqrt(1.0 + 4.0 / (root_beta1 * root_beta1)));
  const double ninths = 2.0 / (9.0 * a);
  const double ratio = (1.0 - 2.0 / a) / (1.0 + x * std::sqrt(2.0 / (a - 4.0)));
  return (1.0 - ninths - std::cbrt(ratio)) / std::sqrt(ninths);
}

}  // namespace

ShapeMoments ComputeShapeMoments(const OrderedSample& sample) {
  const Eigen::ArrayXd deviation = sample.z().array() - sample.z().mean();
  const Eigen::ArrayXd square = deviation.square();
  const double m2 = square.mean();
  const double m3 = (square * deviation).mean();
  const double m4 = square.square().mean();
  return {.skewness = m3 / (m2 * std::sqrt(m2)), .kurtosis = m4 / (m2 * m2)};
}

TestResult AndersonDarling(const OrderedSample& sample) {
  constexpr Index kFewest = 8;
  const std::string why_not = sample.WhyNotWith(kFewest);
  if (!why_not.empty()) return NotApplicable(why_not);
  const VectorXd& z = sample.z();
  const Index size = z.size();
  const double n = static_cast<double>(size);
  double sum = 0.0;
  for (Index i = 0; i < size; ++i) {
    // 1 - F(z) = F(-z).
    sum += static_cast<double>(2 * i + 1) *
           (LogNormalCdf(z[i]) + LogNormalCdf(-z[size - 1 - i]));
  }
  const double a2 = -n - sum / n;
  return {.statistic = a2, .p = AndersonDarlingProbability(a2, n)};
}

TestResult JarqueBera(const OrderedSample& sample) {
  constexpr Index kFewest = 4;  // below it the kurtosis is the same for all
  const std::string why_not = sample.WhyNotWith(kFewest);
  if (!why_not.empty()) return NotApplicable(why_not);
  const ShapeMoments shape = ComputeShapeMoments(sample);
  const double excess = shape.kurtosis - 3.0;
  const double jb = static_cast<double>(sample.size()) / 6.0 *
                    (shape.skewness * shape.skewness + 0.25 * excess * excess);
  return {.statistic = jb, .p = std::exp(-0.5 * jb)};
}

TestResult DAgostinoPearson(const OrderedSample& sample) {
  constexpr Index kFewest = 20;  // below it the kurtosis score is off
  const std::string why_not = sample.WhyNotWith(kFewest);
  if (!why_not.empty()) return NotApplicable(why_not);
  const ShapeMoments shape = ComputeShapeMoments(sample);
  const double n = static_cast<double>(sample.size());
  const double skewness = SkewnessScore(shape.skewness, n);
  const double kurtosis = KurtosisScore(shape.kurtosis, n);
  const double k2 = skewness * skewness + kurtosis * kurtosis;
  return {.statistic = k2, .p = std::exp(-0.5 * k2)};
}

}  // namespace errmap::stats
