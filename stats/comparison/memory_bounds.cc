#include "stats/comparison/memory_bounds.h"

#include <algorithm>
#include <cmath>

#include "stats/distributions.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kFewestUnits = 4;  // n - 3 divides

// Upper 95 % bound of the correlation of neighbours of `x` (n), its mean 0.
double MemoryNotExcluded(const VectorXd& x) {
  constexpr double kMost = 0.98;
  constexpr double kNormal95 = 1.6448536269514722;
  const Index size = x.size();
  const double n = static_cast<double>(size);
  const double r = x.head(size - 1).dot(x.tail(size - 1)) / x.squaredNorm();
  const double rho = std::clamp((n * r + 1.0) / (n - 3.0), -1.0, kMost);
  return std::clamp(
      rho + kNormal95 * std::sqrt((1.0 - rho * rho) / n), 0.0, kMost);
}

}  // namespace

MemoryBounds::MemoryBounds(const UnitLosses& losses) {
  losses.Validate();
  if (losses.num_units() == 0) return;
  rmse_ = PooledRmse(losses);
  influence_ = InfluenceOnRmse(losses, rmse_);
}

MemoryTest MemoryBounds::OfDifference(Index a, Index b) const {
  MemoryTest result;
  if (influence_.rows() < kFewestUnits) {
    result.test = NotApplicable("needs at least 4 units, found " +
                                std::to_string(influence_.rows()));
    return result;
  }
  const VectorXd x = influence_.col(a) - influence_.col(b);
  const double n = static_cast<double>(x.size());
  const double difference = rmse_[a] - rmse_[b];
  // Brought to size 1: squares of very small losses would be lost.
  const double scale = x.cwiseAbs().maxCoeff();
  const VectorXd of_size_1 = scale > 0.0 ? VectorXd(x / scale) : x;
  result.memory = scale > 0.0 ? MemoryNotExcluded(of_size_1) : 0.0;
  const double m =
      std::max(2.0, n * (1.0 - result.memory) / (1.0 + result.memory));
  result.effective_units = m;
  // The mean of m independent values is off by 1 / m of their variance, which
  // the spread about it lacks.
  const double variance = of_size_1.squaredNorm() / n / (1.0 - 1.0 / m);
  const double error = scale * std::sqrt(variance / m);
  const double t = difference == 0.0 ? 0.0 : difference / error;
  result.test = {.statistic = t,
                 .p = std::isfinite(t) ? StudentTwoSided(t, m - 1.0) : 0.0};
  const auto off = [&](double tail) {
    return difference + StudentQuantile(tail, m - 1.0) * error;
  };
  result.bounds = {.lower = off(0.025),
                   .upper = 2.0 * difference - off(0.025),
                   .at_least = off(0.05),
                   .at_most = 2.0 * difference - off(0.05)};
  return result;
}

}  // namespace errmap::stats
