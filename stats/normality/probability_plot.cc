#include "stats/normality/probability_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>

#include <boost/math/tools/minima.hpp>

#include "stats/distributions.h"
#include "stats/require.h"

namespace errmap::stats {
namespace {

constexpr Index kGridSize = 81;
constexpr double kLowestLambda = -2.0;
constexpr double kHighestLambda = 2.0;
constexpr double kNormalLambda = 0.14;

VectorXd GridLambdas() {
  return VectorXd::LinSpaced(kGridSize, kLowestLambda, kHighestLambda);
}

// A sample as seen by a plot against quantiles that are odd about the middle:
// they meet only x_(n+1-i) - x_(i), and their mean is zero.
class MirroredSample {
 public:
  MirroredSample(const Eigen::Ref<const VectorXd>& ascending, Index n) {
    Require(ascending.size() == n,
            "TukeyPlot: made for " + std::to_string(n) + " values",
            ascending.size());
    const Index half = n / 2;
    spread_ = ascending.tail(half) - ascending.head(half).reverse();
    norm_ = (ascending.array() - ascending.mean()).matrix().norm();
  }

  // With the upper half of the quantiles over its norm.
  double Correlation(const Eigen::Ref<const VectorXd>& quantiles) const {
    return std::min(1.0,
                    quantiles.dot(spread_) / (std::numbers::sqrt2 * norm_));
  }

 private:
  VectorXd spread_;  // (n/2)
  double norm_ = 0.0;
};

}  // namespace

VectorXd UniformMedians(Index n) {
  VectorXd medians(n);
  const double size = static_cast<double>(n);
  for (Index i = 0; i < n; ++i) {
    medians[i] = (static_cast<double>(i + 1) - 0.3175) / (size + 0.365);
  }
  if (n > 0) {
    medians[n - 1] = std::pow(0.5, 1.0 / size);
    medians[0] = -std::expm1(-std::log(2.0) / size);
  }
  return medians;
}

VectorXd NormalMedians(Index n) {
  VectorXd quantiles = UniformMedians(n);
  // By halves, so that the plot is symmetric to the last bit.
  for (Index i = 0; i < n / 2; ++i) {
    quantiles[i] = NormalQuantile(quantiles[i]);
    quantiles[n - 1 - i] = -quantiles[i];
  }
  if (n % 2 == 1) quantiles[n / 2] = 0.0;
  return quantiles;
}

double PlotCorrelation(const Eigen::Ref<const VectorXd>& ascending,
                       const Eigen::Ref<const VectorXd>& quantiles) {
  if (ascending.size() != quantiles.size()) {
    throw std::invalid_argument(
        "PlotCorrelation: " + std::to_string(ascending.size()) +
        " values for " + std::to_string(quantiles.size()) + " quantiles");
  }
  const double mean = ascending.mean();
  const double quantile_mean = quantiles.mean();
  const auto x = ascending.array() - mean;
  const auto q = quantiles.array() - quantile_mean;
  const double products = (x * q).sum();
  return std::min(1.0,
                  products / std::sqrt(x.square().sum() * q.square().sum()));
}

TukeyPlot::TukeyPlot(Index n) : n_(n) {
  Require(n >= 2, "TukeyPlot: needs at least 2 values", n);
  // Upper half only: the lower is its mirror image. 1 - p is the mirrored
  // median itself, which keeps the digits of the last ones.
  const VectorXd medians = UniformMedians(n);
  const Index half = n / 2;
  log_p_ = medians.tail(half).array().log();
  log_not_p_ = medians.head(half).reverse().array().log();
  constexpr Index kMostToTabulate = 2000;  // 0.6 MB
  if (n > kMostToTabulate) return;
  const VectorXd lambda = GridLambdas();
  grid_.resize(half, kGridSize);
  for (Index i = 0; i < kGridSize; ++i) {
    grid_.col(i) = Quantiles(lambda[i]).matrix().normalized();
  }
}

Eigen::ArrayXd TukeyPlot::Quantiles(double lambda) const {
  // About 0 the difference of powers cancels; its Taylor series does not.
  constexpr double kSeriesBelow = 1e-5;
  if (std::abs(lambda) < kSeriesBelow) {
    return (log_p_ - log_not_p_) * (1.0 + 0.5 * lambda * (log_p_ + log_not_p_));
  }
  return ((lambda * log_p_).exp() - (lambda * log_not_p_).exp()) / lambda;
}

double TukeyPlot::Correlation(const Eigen::Ref<const VectorXd>& ascending,
                              double lambda) const {
  const MirroredSample sample(ascending, n_);
  return sample.Correlation(Quantiles(lambda).matrix().normalized());
}

TukeyPpcc TukeyPlot::Curve(const Eigen::Ref<const VectorXd>& ascending) const {
  const MirroredSample sample(ascending, n_);
  const auto correlation = [&](double lambda) {
    return sample.Correlation(Quantiles(lambda).matrix().normalized());
  };
  TukeyPpcc curve;
  curve.lambda = GridLambdas();
  curve.r.resize(kGridSize);
  for (Index i = 0; i < kGridSize; ++i) {
    curve.r[i] = grid_.size() > 0 ? sample.Correlation(grid_.col(i))
                                  : correlation(curve.lambda[i]);
  }
  Index best = 0;
  curve.best_r = curve.r.maxCoeff(&best);
  curve.best_lambda = curve.lambda[best];
  // The maximum lies between the neighbours of the best grid point.
  const double low = curve.lambda[std::max<Index>(best - 1, 0)];
  const double high = curve.lambda[std::min(best + 1, kGridSize - 1)];
  constexpr int kBits = 27;  // half of a double's: all that a maximum can give
  std::uintmax_t most_evaluations = 60;
  const auto [lambda, negative_r] = boost::math::tools::brent_find_minima(
      [&](double at) { return -correlation(at); },
      low,
      high,
      kBits,
      most_evaluations);
  if (-negative_r > curve.best_r) {
    curve.best_lambda = lambda;
    curve.best_r = -negative_r;
  }
  curve.r_at_014 = correlation(kNormalLambda);
  return curve;
}

}  // namespace errmap::stats
