#include "stats/comparison/mean_square_bounds.h"

#include <algorithm>
#include <cmath>

#include "stats/comparison/ar1_t_test.h"
#include "stats/random.h"

namespace errmap::stats {
namespace {

constexpr double kExcludedAt = 0.1;

struct Estimate {
  double mean = 0.0;
  double squares = 0.0;  // sum about it, of the whitened series
};

// Generalised least squares of a constant: each value is taken for what its
// neighbour does not predict, the first as it is (Prais & Winsten 1954).
Estimate EstimateFor(double memory, const VectorXd& x) {
  const Index rest = x.size() - 1;
  const double weight = 1.0 / (1.0 + memory);
  const double kept = 1.0 - memory;
  const VectorXd fresh = x.tail(rest) - memory * x.head(rest);
  const double mean = (x[0] + weight * fresh.sum()) /
                      (1.0 + static_cast<double>(rest) * weight * kept);
  return {
      .mean = mean,
      .squares = (x[0] - mean) * (x[0] - mean) +
                 weight / kept * (fresh.array() - kept * mean).square().sum()};
}

// Of `share` of the values at most. Reorders them.
double AtShare(double share, std::vector<double>* values) {
  const double count = static_cast<double>(values->size()) + 1.0;
  const auto nth = values->begin() + std::lround(share * count) - 1;
  std::ranges::nth_element(*values, nth);
  return *nth;
}

}  // namespace

const MeanSquareBounds::Draws& MeanSquareBounds::DrawsOf(double memory) {
  constexpr int kDraws = 1999;
  const auto [place, is_new] = drawn_.try_emplace(memory);
  Draws& draws = place->second;
  if (!is_new) return draws;
  Random random(seed_);
  std::vector<double> ratios;
  for (int draw = 0; draw < kDraws; ++draw) {
    const VectorXd x = AutoregressionSample(size_, memory, &random);
    const Estimate estimate = EstimateFor(memory, x);
    draws.means.push_back(estimate.mean);
    draws.squares.push_back(estimate.squares);
    ratios.push_back(estimate.squares / EstimateFor(0.0, x).squares);
  }
  draws.most_ratio = AtShare(1.0 - kExcludedAt, &ratios);
  return draws;
}

double MeanSquareBounds::LargestMemory(const VectorXd& series) {
  constexpr int kMostTenths = 9;
  constexpr Index kFewestToExclude = 5;
  // So many standard errors above the estimate, no draws are needed.
  constexpr double kFar = 4.0;
  const bool excludes = series.size() >= kFewestToExclude;
  const double most =
      excludes ? MemoryOf(series, 0.0) +
                     kFar / std::sqrt(static_cast<double>(series.size()))
               : 1.0;
  const double without = EstimateFor(0.0, series).squares;
  for (int tenths = kMostTenths; tenths > 0; --tenths) {
    const double memory = tenths / 10.0;
    if (memory > most) continue;
    const double ratio = EstimateFor(memory, series).squares / without;
    if (!excludes || !(ratio > DrawsOf(memory).most_ratio)) return memory;
  }
  return 0.0;
}

Bounds95 MeanSquareBounds::OfRoot(const VectorXd& series,
                                  double memory,
                                  double added) {
  return Wider(With(0.0, series, added), With(memory, series, added));
}

Bounds95 MeanSquareBounds::With(double memory,
                                const VectorXd& series,
                                double added) {
  const Estimate found = EstimateFor(memory, series);
  const Draws& draws = DrawsOf(memory);
  std::vector<double> to_come;
  for (std::size_t i = 0; i < draws.means.size(); ++i) {
    const double sd = std::sqrt(found.squares / draws.squares[i]);
    const double mean = found.mean - sd * draws.means[i];
    to_come.push_back(std::sqrt(added + sd * sd + mean * mean));
  }
  return {.lower = AtShare(0.025, &to_come),
          .upper = AtShare(0.975, &to_come),
          .at_least = AtShare(0.05, &to_come),
          .at_most = AtShare(0.95, &to_come)};
}

}  // namespace errmap::stats
