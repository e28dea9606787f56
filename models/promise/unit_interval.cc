#include "models/promise/unit_interval.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "models/study/judgement/units_of_analysis.h"
#include "stats/comparison/paired_comparison.h"
#include "stats/distributions.h"
#include "stats/randomness.h"
#include "stats/unit_freedom.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// What adds up to a share but for rounding does.
constexpr double kRounding = 1e-9;

// |residual| of each unit.
std::map<Index, std::vector<double>> SizesOfUnits(
    const VectorXd& residuals, const std::vector<Index>& units) {
  std::map<Index, std::vector<double>> sizes;
  for (std::size_t i = 0; i < units.size(); ++i) {
    sizes[units[i]].push_back(std::abs(residuals[static_cast<Index>(i)]));
  }
  return sizes;
}

// The least size that `share` of the units' weight does not exceed, each unit
// of weight 1 shared by its rows.
double QuantileOverUnits(const std::map<Index, std::vector<double>>& sizes,
                         double share) {
  std::vector<std::pair<double, double>> weighted;
  for (const auto& [unit, of_unit] : sizes) {
    for (const double size : of_unit) {
      weighted.emplace_back(size, 1.0 / static_cast<double>(of_unit.size()));
    }
  }
  std::ranges::sort(weighted);
  double left = (share - kRounding) * static_cast<double>(sizes.size());
  for (const auto& [size, weight] : weighted) {
    left -= weight;
    if (left <= 0.0) return size;
  }
  return weighted.back().first;
}

// Student's t over the normal's quantile.
double Widening(const std::map<Index, std::vector<double>>& sizes,
                double coverage) {
  VectorXd mean_squares(static_cast<Index>(sizes.size()));
  Index u = 0;
  for (const auto& [unit, of_unit] : sizes) {
    const Eigen::Map<const VectorXd> values(of_unit.data(),
                                            static_cast<Index>(of_unit.size()));
    mean_squares[u++] =
        values.squaredNorm() / static_cast<double>(values.size());
  }
  const double upper = 0.5 * (1.0 + coverage);
  return stats::StudentQuantile(upper, stats::UnitFreedom(mean_squares)) /
         stats::NormalQuantile(upper);
}

// Where the mean errors of neighbouring sessions go together, as an
// autoregression of the first order would have them, those to come leave what
// was seen: until a quarter of what neighbours share is gone, and never longer
// than a fifth of what was measured, the promise is good.
void FindMemory(const VectorXd& residuals,
                const std::vector<Index>& units,
                PredictionInterval* interval) {
  constexpr double kShared = 0.75;
  constexpr double kMost = 0.98;
  VectorXd means = VectorXd::Zero(interval->units);
  VectorXd rows = means;
  for (std::size_t i = 0; i < units.size(); ++i) {
    means[units[i]] += residuals[static_cast<Index>(i)];
    rows[units[i]] += 1.0;
  }
  const stats::SerialTests serial =
      stats::TestSerially({means.cwiseQuotient(rows)});
  interval->lag1 = serial.lag1.statistic;
  // Of fewer, memory shows in one case of eight.
  constexpr Index kFewestSessions = 10;
  if (interval->units < kFewestSessions || !serial.lag1.ok() ||
      serial.lag1.p > stats::kSignificance ||
      serial.lag1.statistic < serial.expected_lag1) {
    return;
  }
  // Free of its bias: stats/comparison/memory_bounds.h.
  const auto n = static_cast<double>(interval->units);
  const double memory =
      std::clamp((n * interval->lag1 + 1.0) / (n - 3.0), kShared, kMost);
  const auto lasts =
      static_cast<Index>(std::floor(std::log(kShared) / std::log(memory)));
  interval->good_for = std::clamp(lasts, Index{1}, interval->units / 5);
}

}  // namespace

PredictionInterval::Level UnitIntervalLevel(const VectorXd& residuals,
                                            const std::vector<Index>& units,
                                            double coverage) {
  PredictionInterval::Level level;
  level.coverage = coverage;
  const auto sizes = SizesOfUnits(residuals, units);
  if (sizes.size() < 2 || !residuals.allFinite()) return level;
  const auto count = static_cast<double>(sizes.size());
  level.at_least = (count + 1.0) * coverage > count + kRounding;
  level.half_width =
      QuantileOverUnits(sizes, coverage) * Widening(sizes, coverage);
  level.inside = level.outside = level.half_width;
  return level;
}

namespace {

// Of those rows alone that are (not) inside of what was trained.
double HalfWidthOf(const VectorXd& residuals,
                   const std::vector<Index>& units,
                   const std::vector<bool>& inside,
                   bool wanted,
                   double coverage) {
  std::vector<Index> rows;
  std::vector<Index> of_rows;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (inside[i] != wanted) continue;
    rows.push_back(static_cast<Index>(i));
    of_rows.push_back(units[i]);
  }
  return UnitIntervalLevel(residuals(rows), of_rows, coverage).half_width;
}

}  // namespace

std::optional<PredictionInterval> PromiseOf(
    const data::Dataset& dataset,
    const Holdout& holdout,
    const HoldoutResult& result,
    const std::function<std::vector<bool>()>& inside) {
  if (!result.ok() || holdout.among_neighbours) return std::nullopt;
  const HeldOutRows held = GatherHeldOut(dataset, holdout);
  PredictionInterval interval;
  interval.holdout = holdout.name;
  UnitsOfAnalysis units;
  const std::vector<Index> codes = AssignUnits(holdout, held, &units);
  interval.unit = units.name;
  interval.units = static_cast<Index>(units.labels.size());
  interval.of_sessions = units.are_sessions;
  if (interval.units < 2) return std::nullopt;
  const VectorXd residuals = ResidualsOf(held, result);
  const std::vector<bool> is_inside = inside ? inside() : std::vector<bool>{};
  for (const double coverage : PredictionInterval::kCoverages) {
    PredictionInterval::Level level =
        UnitIntervalLevel(residuals, codes, coverage);
    const double in = HalfWidthOf(residuals, codes, is_inside, true, coverage);
    const double out =
        HalfWidthOf(residuals, codes, is_inside, false, coverage);
    if (in <= out) {
      level.inside = std::min(in, level.half_width);
      level.outside = std::max(out, level.half_width);
    }
    interval.levels.push_back(level);
  }
  if (interval.of_sessions) FindMemory(residuals, codes, &interval);
  return interval;
}

}  // namespace errmap::models
