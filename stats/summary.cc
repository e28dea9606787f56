#include "stats/summary.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "stats/not_a_number.h"
#include "stats/power_of_two.h"
#include "stats/require.h"

namespace errmap::stats {
namespace {

// Neumaier's running sum: the rounding error of each addition is collected.
class RunningSum {
 public:
  void Add(double value) {
    const double sum = sum_ + value;
    error_ += std::abs(sum_) >= std::abs(value) ? (sum_ - sum) + value
                                                : (value - sum) + sum_;
    sum_ = sum;
  }
  // The correction is NaN once the sum has overflowed; the sum then tells more.
  double value() const { return std::isfinite(sum_) ? sum_ + error_ : sum_; }

 private:
  double sum_ = 0.0;
  double error_ = 0.0;
};

}  // namespace

double CompensatedSum(const Eigen::Ref<const VectorXd>& values) {
  RunningSum sum;
  for (const double value : values) sum.Add(value);
  return sum.value();
}

SampleSummary Summarize(const Eigen::Ref<const VectorXd>& sample) {
  SampleSummary summary;
  summary.n = sample.size();
  if (summary.n == 0) {
    summary.mean = summary.sd = summary.min = summary.max = summary.range =
        kNaN;
    return summary;
  }
  const double n = static_cast<double>(summary.n);
  summary.min = sample.minCoeff();
  summary.max = sample.maxCoeff();
  summary.range = summary.max - summary.min;
  summary.mean = CompensatedSum(sample) / n;
  RunningSum squares;
  RunningSum deviations;
  for (const double value : sample) {
    const double deviation = value - summary.mean;
    squares.Add(deviation * deviation);
    deviations.Add(deviation);
  }
  if (summary.range > 0.0 && !std::isnormal(squares.value())) {
    // For values whose squares overflow: computed on values scaled to size 1.
    const double scale = PowerOfTwoOf(sample);
    if (std::isfinite(scale) && scale != 1.0) {
      const SampleSummary scaled = Summarize(sample / scale);
      summary.mean = scale * scaled.mean;
      summary.sd = scale * scaled.sd;
      return summary;
    }
  }
  const double mean_error = deviations.value() / n;
  summary.mean += mean_error;
  // The second term mends what the rounded mean has added to the squares.
  const double sum_of_squares =
      squares.value() - deviations.value() * mean_error;
  summary.sd = summary.n < 2
                   ? kNaN
                   : std::sqrt(std::max(0.0, sum_of_squares) / (n - 1.0));
  return summary;
}

double StandardError(double sd, Index n) {
  return sd / std::sqrt(static_cast<double>(n));
}

VectorXd Standardise(const Eigen::Ref<const VectorXd>& sample) {
  // Brought to size 1: squares of very large or small values would be lost.
  const VectorXd scaled = sample / PowerOfTwoOf(sample);
  const SampleSummary summary = Summarize(scaled);
  if (!(summary.sd > 0.0)) {
    throw std::invalid_argument(
        "Standardise: needs at least 2 different values, all finite; found " +
        std::to_string(sample.size()));
  }
  return (scaled.array() - summary.mean) / summary.sd;
}

double Correlation(const Eigen::Ref<const VectorXd>& a,
                   const Eigen::Ref<const VectorXd>& b) {
  constexpr double kLeast = 1e-300;
  const VectorXd u = a.array() - a.mean();
  const VectorXd v = b.array() - b.mean();
  return u.dot(v) / std::max(u.norm() * v.norm(), kLeast);
}

double Quantile(const Eigen::Ref<const VectorXd>& ascending,
                double probability) {
  Require(probability >= 0.0 && probability <= 1.0,
          "Quantile: probability must be within 0 and 1",
          probability);
  const Index n = ascending.size();
  if (n == 0) return kNaN;
  const double at = probability * static_cast<double>(n - 1);
  const auto below = static_cast<Index>(at);
  const Index above = std::min(below + 1, n - 1);
  const double share = at - static_cast<double>(below);
  return (1.0 - share) * ascending[below] + share * ascending[above];
}

Histogram MakeHistogram(const Eigen::Ref<const VectorXd>& ascending,
                        Index bins) {
  const Index n = ascending.size();
  if (n == 0 || !ascending.allFinite() || bins < 0) {
    throw std::invalid_argument(
        "MakeHistogram: needs finite values and at least 0 bins, found " +
        std::to_string(n) + " values, " + std::to_string(bins) + " bins");
  }
  constexpr double kMostBins = 1000.0;
  const double low = ascending[0];
  const double range = ascending[n - 1] - low;
  if (!(range > 0.0)) return {.low = low, .width = 0.0, .counts = {n}};
  if (std::isinf(range)) {  // the largest doubles apart
    constexpr double kShrink = 0.25;
    Histogram histogram = MakeHistogram(kShrink * ascending, bins);
    histogram.low = low;
    histogram.width /= kShrink;
    return histogram;
  }
  if (bins == 0) {
    const double size = static_cast<double>(n);
    const double iqr = Quantile(ascending, 0.75) - Quantile(ascending, 0.25);
    const double wanted = iqr > 0.0 ? range / (2.0 * iqr / std::cbrt(size))
                                    : std::log2(size) + 1.0;
    bins = static_cast<Index>(std::ceil(std::clamp(wanted, 1.0, kMostBins)));
  }
  Histogram histogram;
  histogram.low = low;
  histogram.width = range / static_cast<double>(bins);
  histogram.counts.assign(static_cast<std::size_t>(bins), 0);
  for (const double value : ascending) {
    const auto bin =
        static_cast<Index>((value - low) / range * static_cast<double>(bins));
    ++histogram.counts[static_cast<std::size_t>(std::min(bin, bins - 1))];
  }
  return histogram;
}

}  // namespace errmap::stats
