#include "stats/summary.h"

#include <cmath>
#include <limits>

namespace errmap::stats {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

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

double CompensatedSum(const Eigen::Ref<const Eigen::VectorXd>& values) {
  RunningSum sum;
  for (const double value : values) sum.Add(value);
  return sum.value();
}

SampleSummary Summarize(const Eigen::Ref<const Eigen::VectorXd>& sample) {
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

}  // namespace errmap::stats
