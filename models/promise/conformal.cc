#include "models/promise/conformal.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "models/study/judgement/units_of_analysis.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// The ceil(share * n)-th smallest of n values, at most the largest.
double OrderStatistic(std::vector<double> values, double rank) {
  // A rank that is whole but for rounding is that rank.
  constexpr double kRounding = 1e-9;
  const auto count = static_cast<double>(values.size());
  const double place =
      std::clamp(std::ceil(rank - kRounding), 1.0, count) - 1.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::ranges::nth_element(values, at);
  return *at;
}

}  // namespace

PredictionInterval::Level ConformalLevel(const VectorXd& residuals,
                                         const std::vector<Index>& units,
                                         double coverage) {
  PredictionInterval::Level level;
  level.coverage = coverage;
  if (residuals.size() == 0 || !residuals.allFinite()) return level;
  std::map<Index, std::vector<double>> sizes;
  for (std::size_t i = 0; i < units.size(); ++i) {
    sizes[units[i]].push_back(std::abs(residuals[static_cast<Index>(i)]));
  }
  std::vector<double> of_units;
  for (auto& [unit, values] : sizes) {
    const double rank = coverage * static_cast<double>(values.size());
    of_units.push_back(OrderStatistic(std::move(values), rank));
  }
  const auto count = static_cast<double>(of_units.size());
  const double rank = (count + 1.0) * coverage;
  constexpr double kRounding = 1e-9;
  level.at_least = rank > count + kRounding;
  level.half_width = OrderStatistic(std::move(of_units), rank);
  return level;
}

std::optional<PredictionInterval> PromiseOf(const data::Dataset& dataset,
                                            const Holdout& holdout,
                                            const HoldoutResult& result) {
  if (!result.ok() || holdout.among_neighbours) return std::nullopt;
  const HeldOutRows held = GatherHeldOut(dataset, holdout);
  PredictionInterval interval;
  interval.holdout = holdout.name;
  UnitsOfAnalysis units;
  const std::vector<Index> codes = AssignUnits(holdout, held, &units);
  interval.unit = units.name;
  interval.units = static_cast<Index>(units.labels.size());
  if (interval.units < 2) return std::nullopt;
  const VectorXd residuals = ResidualsOf(held, result);
  for (const double coverage : PredictionInterval::kCoverages) {
    interval.levels.push_back(ConformalLevel(residuals, codes, coverage));
  }
  return interval;
}

}  // namespace errmap::models
