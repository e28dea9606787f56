#include "stats/report_1995.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace errmap::stats {
namespace {

// Complementary error function with fractional error below 1.2e-7: the
// Chebyshev fit of Press et al. that Appendix A uses (function ERFCC).
float ErfcApproximation(float x) {
  const float z = std::abs(x);
  const float t = 1.0F / (1.0F + 0.5F * z);
  constexpr float kCoefficients[] = {-1.26551223F,
                                     1.00002368F,
                                     0.37409196F,
                                     0.09678418F,
                                     -0.18628806F,
                                     0.27886807F,
                                     -1.13520398F,
                                     1.48851587F,
                                     -0.82215223F,
                                     0.17087277F};
  float series = 0.0F;
  for (auto c = std::rbegin(kCoefficients); c != std::rend(kCoefficients);
       ++c) {
    series = series * t + *c;
  }
  const float value = t * std::exp(-z * z + series);
  return x < 0.0F ? 2.0F - value : value;
}

float NormalCdf(float x) {
  const float half_width =
      1.0F - ErfcApproximation(std::abs(x) / std::sqrt(2.0F));
  const float upper = 0.5F * (1.0F + half_width);
  return x >= 0.0F ? upper : 1.0F - upper;
}

float KsDistance(Eigen::VectorXf sample) {
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<float>(sample.size());
  float distance = 0.0F;
  float below = 0.0F;
  for (Eigen::Index j = 0; j < sample.size(); ++j) {
    const float above = static_cast<float>(j + 1) / n;
    const float cdf = NormalCdf(sample[j]);
    distance =
        std::max({distance, std::abs(below - cdf), std::abs(above - cdf)});
    below = above;
  }
  return distance;
}

float KsProbability(float lambda) {
  constexpr float kTermRatio = 0.001F;
  constexpr float kSumRatio = 1e-8F;
  const float exponent = -2.0F * lambda * lambda;
  float factor = 2.0F;
  float sum = 0.0F;
  float last = 0.0F;
  for (int j = 1; j <= 100; ++j) {
    const float term = factor * std::exp(exponent * static_cast<float>(j * j));
    sum += term;
    if (std::abs(term) < kTermRatio * last ||
        std::abs(term) < kSumRatio * sum) {
      return sum;
    }
    factor = -factor;
    last = std::abs(term);
  }
  return 1.0F;
}

// np and j stand one past their limits after the loops: np*j = (n+1)*2.
float DivisorOf(Eigen::Index n) { return static_cast<float>((n + 1) * 2); }

}  // namespace

Report1995Statistics ComputeAsPrinted1995(
    const Eigen::Ref<const Eigen::VectorXd>& residuals) {
  if (residuals.size() == 0) {
    throw std::invalid_argument("ComputeAsPrinted1995: no residuals");
  }
  const Eigen::VectorXf errors = residuals.cast<float>();
  const float divisor = DivisorOf(errors.size());
  float sum = 0.0F;
  for (const float error : errors) sum += error;
  const float mean = sum / divisor;
  float squares = 0.0F;
  for (const float error : errors) squares += (error - mean) * (error - mean);
  const float sd = std::sqrt(squares / (divisor - 1.0F));

  Report1995Statistics printed;
  printed.n = errors.size();
  printed.mean = static_cast<double>(mean);
  printed.sd = static_cast<double>(sd);
  constexpr float kFirstMin = 1e20F;
  constexpr float kFirstMax = 1e-20F;
  printed.min = static_cast<double>(std::min(kFirstMin, errors.minCoeff()));
  printed.max = static_cast<double>(std::max(kFirstMax, errors.maxCoeff()));
  const Eigen::VectorXf standardised = (errors.array() - mean) / sd;
  const float distance = KsDistance(standardised);
  printed.ks_d = static_cast<double>(distance);
  printed.ks_probability = static_cast<double>(
      KsProbability(std::sqrt(static_cast<float>(errors.size())) * distance));
  return printed;
}

double RSquaredAsPrinted1995(
    const Eigen::Ref<const Eigen::VectorXd>& targets,
    const Eigen::Ref<const Eigen::VectorXd>& predicted) {
  if (targets.size() == 0 || targets.size() != predicted.size()) {
    throw std::invalid_argument(
        "RSquaredAsPrinted1995: needs as many predictions as targets, at least "
        "one; found " +
        std::to_string(predicted.size()) + " and " +
        std::to_string(targets.size()));
  }
  const Eigen::VectorXf target = targets.cast<float>();
  const Eigen::VectorXf output = predicted.cast<float>();
  float sum = 0.0F;
  for (const float value : target) sum += value;
  const float mean = sum / DivisorOf(target.size());
  float total = 0.0F;
  float regression = 0.0F;
  for (Eigen::Index i = 0; i < target.size(); ++i) {
    total += (target[i] - mean) * (target[i] - mean);
    regression += (output[i] - mean) * (output[i] - mean);
  }
  return static_cast<double>(regression / total);
}

}  // namespace errmap::stats
