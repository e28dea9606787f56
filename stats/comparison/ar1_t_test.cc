#include "stats/comparison/ar1_t_test.h"

#include <algorithm>
#include <cmath>

#include "stats/distributions.h"

namespace errmap::stats {
namespace {

constexpr Index kFewestUnits = 4;  // n - 3 divides

constexpr double kMostMemorable = 0.98;

struct MemoryEstimate {
  double rho = 0.0;
  double error = 0.0;  // standard, of rho
};

MemoryEstimate EstimateMemory(const Eigen::Ref<const VectorXd>& series) {
  const Index size = series.size();
  const double n = static_cast<double>(size);
  // Brought to size 1: squares of very small losses would be lost.
  VectorXd x = series.array() - series.mean();
  const double scale = x.cwiseAbs().maxCoeff();
  // The mean of equal values is off by their last digits.
  constexpr double kRounding = 1e-12;
  if (!(scale > kRounding * series.cwiseAbs().maxCoeff())) return {};
  x /= scale;
  const double r = x.head(size - 1).dot(x.tail(size - 1)) / x.squaredNorm();
  const double rho =
      std::clamp((n * r + 1.0) / (n - 3.0), -1.0, kMostMemorable);
  return {.rho = rho, .error = std::sqrt((1.0 - rho * rho) / n)};
}

double With(const MemoryEstimate& found, double margin) {
  return std::clamp(found.rho + margin * found.error, 0.0, kMostMemorable);
}

}  // namespace

double MemoryOf(const Eigen::Ref<const VectorXd>& series, double margin) {
  return With(EstimateMemory(series), margin);
}

double ShownMemory(const Eigen::Ref<const VectorXd>& series, double above) {
  const MemoryEstimate found = EstimateMemory(series);
  return found.rho > above / std::sqrt(static_cast<double>(series.size()))
             ? With(found, kLikelyMemory)
             : 0.0;
}

double EffectiveUnits(Index units, double memory) {
  return std::max(2.0,
                  static_cast<double>(units) * (1.0 - memory) / (1.0 + memory));
}

MeanWithMemory OfMean(Index units, double memory) {
  // Of R, the correlations memory^|i - j|, and A, which takes the mean from
  // each value: s^2 is x' A x / (n - 1).
  const auto n = static_cast<double>(units);
  double all = n;             // 1'R1
  double squares = n;         // tr(R R)
  double squared_sums = 0.0;  // 1'R R 1
  for (Index i = 0; i < units; ++i) {
    const auto lag = static_cast<double>(i);
    if (i > 0) {
      all += 2.0 * (n - lag) * std::pow(memory, lag);
      squares += 2.0 * (n - lag) * std::pow(memory, 2.0 * lag);
    }
    const double row = (1.0 + memory - std::pow(memory, lag + 1.0) -
                        std::pow(memory, n - lag)) /
                       (1.0 - memory);
    squared_sums += row * row;
  }
  const double trace = n - all / n;  // of A R
  const double of_square =           // of A R A R
      squares - 2.0 * squared_sums / n + all * all / (n * n);
  return {.inflation = std::sqrt(all / n * (n - 1.0) / trace),
          .degrees_of_freedom = trace * trace / of_square};
}

Ar1TTest::Ar1TTest(const UnitLosses& losses) {
  losses.Validate();
  if (losses.num_units() == 0) return;
  rmse_ = PooledRmse(losses);
  influence_ = InfluenceOnRmse(losses, rmse_);
  within_ = losses.mean_squares;
  if (losses.means.size() > 0) within_ -= losses.means.cwiseAbs2();
}

double Ar1TTest::InDifference(Index a, Index b, double margin) const {
  return influence_.rows() < kFewestUnits
             ? 0.0
             : MemoryOf(influence_.col(a) - influence_.col(b), margin);
}

double Ar1TTest::ShownInDifference(Index a, Index b) const {
  return influence_.rows() < kFewestUnits
             ? 0.0
             : ShownMemory(influence_.col(a) - influence_.col(b));
}

double Ar1TTest::Worth(Index model) const {
  constexpr Index kFewestForLosses = 20;
  const Index units = within_.rows();
  if (units < kFewestForLosses) return 1.0;
  const VectorXd within =
      within_.col(model).array() - within_.col(model).mean();
  const double all = 2.0 * rmse_[model] * influence_.col(model).norm();
  const double share = all > 0.0 ? std::min(1.0, within.norm() / all) : 0.0;
  const double effective =
      EffectiveUnits(units, ShownMemory(within_.col(model), kSuspected));
  return 1.0 /
         (1.0 + share * share * (static_cast<double>(units) / effective - 1.0));
}

MemoryTest Ar1TTest::OfDifference(Index a, Index b, double memory) const {
  MemoryTest result;
  if (influence_.rows() < kFewestUnits) {
    result.test = NotApplicable("needs at least 4 units, found " +
                                std::to_string(influence_.rows()));
    return result;
  }
  const VectorXd x = influence_.col(a) - influence_.col(b);
  const double n = static_cast<double>(x.size());
  const double difference = rmse_[a] - rmse_[b];
  const double scale = x.cwiseAbs().maxCoeff();
  const VectorXd of_size_1 = scale > 0.0 ? VectorXd(x / scale) : x;
  result.memory = memory;
  const MeanWithMemory mean = OfMean(x.size(), memory);
  const double freedom = mean.degrees_of_freedom;
  result.degrees_of_freedom = freedom;
  const double error = scale * mean.inflation *
                       std::sqrt(of_size_1.squaredNorm() / (n - 1.0) / n);
  const double t = difference == 0.0 ? 0.0 : difference / error;
  result.test = {.statistic = t,
                 .p = std::isfinite(t) ? StudentTwoSided(t, freedom) : 0.0};
  const auto off = [&](double tail) {
    return difference + StudentQuantile(tail, freedom) * error;
  };
  result.bounds = {.lower = off(0.025),
                   .upper = 2.0 * difference - off(0.025),
                   .at_least = off(0.05),
                   .at_most = 2.0 * difference - off(0.05)};
  return result;
}

}  // namespace errmap::stats
