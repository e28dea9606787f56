#include "stats/error_metrics.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "stats/power_of_two.h"
#include "stats/summary.h"

namespace errmap::stats {

namespace {

// `sum` of the squares.
double RootMeanSquare(const Eigen::Ref<const VectorXd>& residuals, double sum) {
  const auto n = static_cast<double>(residuals.size());
  if (std::isnormal(sum)) return std::sqrt(sum / n);
  const double scale = PowerOfTwoOf(residuals);
  if (!std::isfinite(scale)) return std::sqrt(sum / n);
  const VectorXd scaled = residuals / scale;
  return scale * std::sqrt(CompensatedSum(scaled.cwiseAbs2()) / n);
}

}  // namespace

double RootMeanSquare(const Eigen::Ref<const VectorXd>& residuals) {
  return RootMeanSquare(residuals, CompensatedSum(residuals.cwiseAbs2()));
}

double GeometricMean(const Eigen::Ref<const VectorXd>& sizes) {
  constexpr double kLeast = std::numeric_limits<double>::min();
  return std::exp(sizes.array().max(kLeast).log().mean());
}

ErrorMetrics ComputeErrorMetrics(const Eigen::Ref<const VectorXd>& targets,
                                 const Eigen::Ref<const VectorXd>& residuals,
                                 const Eigen::Ref<const VectorXd>& baseline) {
  if (targets.size() != residuals.size() || targets.size() != baseline.size()) {
    throw std::invalid_argument(
        "ComputeErrorMetrics: targets, residuals and baseline must have one "
        "size; found " +
        std::to_string(targets.size()) + ", " +
        std::to_string(residuals.size()) + ", " +
        std::to_string(baseline.size()));
  }
  const SampleSummary summary = Summarize(residuals);
  ErrorMetrics metrics{.n = summary.n,
                       .mean = summary.mean,
                       .sd = summary.sd,
                       .min = summary.min,
                       .max = summary.max,
                       .range = summary.range};
  const VectorXd magnitudes = residuals.cwiseAbs();
  const VectorXd spread = (targets - baseline).cwiseAbs2();
  const double n = static_cast<double>(residuals.size());
  const double squared_error = CompensatedSum(residuals.cwiseAbs2());
  metrics.rmse = RootMeanSquare(residuals, squared_error);
  metrics.mae = CompensatedSum(magnitudes) / n;
  const double total = CompensatedSum(spread);
  metrics.r2 = total > 0.0 ? 1.0 - squared_error / total : kNaN;
  return metrics;
}

}  // namespace errmap::stats
