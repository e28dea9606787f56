#include "stats/normality/simulated_quantiles.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "stats/distributions.h"
#include "stats/normality/simulated_quantiles_data.h"
#include "stats/require.h"

namespace errmap::stats {
namespace {

// Returns a value that varies slowly with n and smoothly with p.
double Scaled(SimulatedStatistic statistic, double value, double n) {
  switch (statistic) {
    case SimulatedStatistic::kNormalPpcc:
    case SimulatedStatistic::kTukeyMaxPpcc:
      return std::log(value * n);
    case SimulatedStatistic::kLilliefors:
    case SimulatedStatistic::kDip:
      break;
  }
  return value * std::sqrt(n);
}

double Unscaled(SimulatedStatistic statistic, double scaled, double n) {
  switch (statistic) {
    case SimulatedStatistic::kNormalPpcc:
    case SimulatedStatistic::kTukeyMaxPpcc:
      return std::exp(scaled) / n;
    case SimulatedStatistic::kLilliefors:
    case SimulatedStatistic::kDip:
      break;
  }
  return scaled / std::sqrt(n);
}

// The scaled quantiles at this n, ascending. Beyond the largest size they
// stay (D, dip) or follow the last two sizes' trend (correlations).
simulated::Quantiles ScaledQuantiles(SimulatedStatistic statistic, Index n) {
  const auto& table = simulated::kTables[static_cast<std::size_t>(statistic)];
  const auto& sizes = simulated::kSizes;
  const auto above = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
      std::lower_bound(sizes.begin(), sizes.end(), n) - sizes.begin(),
      1,
      std::ssize(sizes) - 1));
  const double low = sizes[above - 1];
  const double high = sizes[above];
  double weight = std::log(static_cast<double>(n) / low) / std::log(high / low);
  if (statistic == SimulatedStatistic::kLilliefors ||
      statistic == SimulatedStatistic::kDip) {
    weight = std::min(weight, 1.0);
  }
  simulated::Quantiles quantiles{};
  for (std::size_t i = 0; i < quantiles.size(); ++i) {
    const double at_low = Scaled(statistic, table[above - 1][i], low);
    const double at_high = Scaled(statistic, table[above][i], high);
    quantiles[i] = at_low + weight * (at_high - at_low);
  }
  return quantiles;
}

const simulated::Quantiles& LevelScores() {
  static const simulated::Quantiles kScores = [] {
    simulated::Quantiles made{};
    for (std::size_t i = 0; i < made.size(); ++i) {
      made[i] = NormalQuantile(simulated::kLevels[i]);
    }
    return made;
  }();
  return kScores;
}

void RequireSize(Index n) {
  Require(n >= kFewestSimulated,
          "simulated quantiles: needs at least " +
              std::to_string(kFewestSimulated) + " values",
          n);
}

}  // namespace

double SimulatedProbability(SimulatedStatistic statistic,
                            double value,
                            Index n) {
  RequireSize(n);
  if (std::isnan(value)) return value;
  if (!(value > 0.0)) return kLargestSimulated;
  const simulated::Quantiles quantiles = ScaledQuantiles(statistic, n);
  const double scaled = Scaled(statistic, value, static_cast<double>(n));
  if (scaled <= quantiles.front()) return kLargestSimulated;
  if (scaled >= quantiles.back()) return kSmallestSimulated;
  const auto above = static_cast<std::size_t>(
      std::upper_bound(quantiles.begin(), quantiles.end(), scaled) -
      quantiles.begin());
  const double share = (scaled - quantiles[above - 1]) /
                       (quantiles[above] - quantiles[above - 1]);
  const auto& scores = LevelScores();
  return NormalCdf(scores[above - 1] +
                   share * (scores[above] - scores[above - 1]));
}

double SimulatedCriticalValue(SimulatedStatistic statistic,
                              double probability,
                              Index n) {
  RequireSize(n);
  Require(probability >= kSmallestSimulated && probability <= kLargestSimulated,
          "SimulatedCriticalValue: probability must be within 0.001 and 0.999",
          probability);
  const auto& levels = simulated::kLevels;
  std::size_t below = 1;  // first level not above the probability
  while (levels[below] > probability) ++below;
  const auto& scores = LevelScores();
  const double share = (NormalQuantile(probability) - scores[below - 1]) /
                       (scores[below] - scores[below - 1]);
  const simulated::Quantiles quantiles = ScaledQuantiles(statistic, n);
  return Unscaled(
      statistic,
      quantiles[below - 1] + share * (quantiles[below] - quantiles[below - 1]),
      static_cast<double>(n));
}

}  // namespace errmap::stats
