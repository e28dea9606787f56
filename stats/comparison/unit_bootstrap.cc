#include "stats/comparison/unit_bootstrap.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "stats/distributions.h"
#include "stats/random.h"
#include "stats/require.h"
#include "stats/satterthwaite_dof.h"

namespace errmap::stats {
namespace {

constexpr Index kFewestForBootstrap = 2;

// Number of times each unit is drawn per resample (resamples x units). Avoids
// Random::Below: its divisions take most of the time, and 53 bits are fair to 1
// in 10^12 for a thousand units.
MatrixXd DrawCounts(Index resamples, Index units, Random* random) {
  MatrixXd counts = MatrixXd::Zero(resamples, units);
  for (Index i = 0; i < resamples; ++i) {
    for (Index drawn = 0; drawn < units; ++drawn) {
      const double at = random->Uniform() * static_cast<double>(units);
      counts(i, static_cast<Index>(at)) += 1.0;
    }
  }
  return counts;
}

// The order statistic at probability p, between neighbours by a straight line
// (R's type 6). Reorders `values`.
double Quantile(double p, VectorXd* values) {
  const double last = static_cast<double>(values->size() - 1);
  const double at =
      std::clamp(p * static_cast<double>(values->size() + 1) - 1.0, 0.0, last);
  const Index below = static_cast<Index>(at);
  auto nth = values->begin() + below;
  std::nth_element(values->begin(), nth, values->end());
  const double value = *nth;
  if (static_cast<double>(below) == at) return value;
  const double next = *std::min_element(nth + 1, values->end());
  return value + (at - static_cast<double>(below)) * (next - value);
}

// RMSE of every model in every resample (resamples x models).
MatrixXd Resample(const UnitLosses& losses,
                  Index resamples,
                  std::uint64_t seed) {
  const Index models = losses.num_models();
  // One column of rows, then one of summed squares per model.
  MatrixXd sums(losses.num_units(), 1 + models);
  sums.col(0) = losses.rows;
  sums.rightCols(models) = losses.rows.asDiagonal() * losses.mean_squares;
  MatrixXd rmse(resamples, models);
  Random random(seed);
  constexpr Index kAtATime = 256;  // keeps counts and sums in the cache
  for (Index done = 0; done < resamples; done += kAtATime) {
    const Index num = std::min(kAtATime, resamples - done);
    const MatrixXd drawn = DrawCounts(num, losses.num_units(), &random) * sums;
    rmse.middleRows(done, num) =
        (drawn.rightCols(models).array().colwise() / drawn.col(0).array())
            .sqrt();
  }
  return rmse;
}

// The value `t` standard errors from the estimate.
using ByT = std::function<double(double t)>;

Bounds95 Bound(Index units, VectorXd resampled, const ByT& by_t) {
  const double n = static_cast<double>(units);
  const auto low = [&](double tail) {
    const double t = StudentQuantile(tail, n - 1.0);
    const double expanded = NormalCdf(std::sqrt(n / (n - 1.0)) * t);
    return std::min(by_t(t), Quantile(expanded, &resampled));
  };
  const auto high = [&](double tail) {
    const double t = StudentQuantile(tail, n - 1.0);
    const double expanded = NormalCdf(std::sqrt(n / (n - 1.0)) * t);
    return std::max(by_t(-t), Quantile(1.0 - expanded, &resampled));
  };
  return {.lower = low(0.025),
          .upper = high(0.025),
          .at_least = low(0.05),
          .at_most = high(0.05)};
}

// Widens `bounds` to those of the square root of a mean square with so many
// degrees of freedom.
void WidenByChiSquared(double rmse, double freedom, Bounds95* bounds) {
  // Beyond these the quantiles no longer move.
  constexpr double kFewest = 1.0;
  constexpr double kMost = 1e6;
  const double f = std::clamp(freedom, kFewest, kMost);
  const auto at = [=](double probability) {
    return rmse * std::sqrt(f / ChiSquaredQuantile(probability, f));
  };
  bounds->lower = std::min(bounds->lower, at(0.975));
  bounds->upper = std::max(bounds->upper, at(0.025));
  bounds->at_least = std::min(bounds->at_least, at(0.95));
  bounds->at_most = std::max(bounds->at_most, at(0.05));
}

double StandardError(const VectorXd& influence) {
  const double n = static_cast<double>(influence.size());
  return influence.norm() / std::sqrt(n * (n - 1.0));
}

}  // namespace

Bounds95 Wider(const Bounds95& one, const Bounds95& other) {
  return {.lower = std::min(one.lower, other.lower),
          .upper = std::max(one.upper, other.upper),
          .at_least = std::min(one.at_least, other.at_least),
          .at_most = std::max(one.at_most, other.at_most)};
}

UnitBootstrap::UnitBootstrap(const UnitLosses& losses,
                             Index resamples,
                             std::uint64_t seed)
    : units_(losses.num_units()) {
  Require(
      resamples >= 99, "UnitBootstrap: needs at least 99 resamples", resamples);
  losses.Validate();
  if (units_ < kFewestForBootstrap) return;
  rmse_ = PooledRmse(losses);
  influence_ = InfluenceOnRmse(losses, rmse_);
  resampled_ = Resample(losses, resamples, seed);
}

Bounds95 UnitBootstrap::OfRmse(Index model, double worth) const {
  if (units_ < kFewestForBootstrap) return {};
  const double rmse = rmse_[model];
  if (rmse == 0.0) {
    return {.lower = 0.0, .upper = 0.0, .at_least = 0.0, .at_most = 0.0};
  }
  const double relative_error = StandardError(influence_.col(model)) / rmse;
  Bounds95 bounds = Bound(units_, resampled_.col(model), [=](double t) {
    return rmse * std::exp(t * relative_error);
  });
  // Contribution of a unit to the mean square, as a share: twice that to the
  // RMSE.
  constexpr double kNoLeast = 0.0;
  const VectorXd squares = 1.0 + 2.0 * influence_.col(model).array() / rmse;
  const double freedom = SatterthwaiteDof(squares, kNoLeast);
  WidenByChiSquared(rmse, worth * freedom, &bounds);
  return bounds;
}

Bounds95 UnitBootstrap::OfDifference(Index a, Index b) const {
  if (units_ < kFewestForBootstrap) return {};
  const double difference = rmse_[a] - rmse_[b];
  const double error = StandardError(influence_.col(a) - influence_.col(b));
  return Bound(units_, resampled_.col(a) - resampled_.col(b), [=](double t) {
    return difference + t * error;
  });
}

}  // namespace errmap::stats
