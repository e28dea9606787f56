#include "models/uncertainty/unit_interval.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "models/study/judgement/units_of_analysis.h"
#include "stats/comparison/ar1_t_test.h"
#include "stats/distributions.h"
#include "stats/randomness.h"
#include "stats/satterthwaite_dof.h"

namespace errmap::models {
namespace {

// A sum of weights this close to a share counts as reaching it.
constexpr double kRounding = 1e-9;

// |residual| of all rows, ascending: units weigh 1, shared by their rows.
class SizesOfUnits {
 public:
  SizesOfUnits(const VectorXd& residuals, const std::vector<Index>& units) {
    std::map<Index, std::vector<double>> sizes;
    for (std::size_t i = 0; i < units.size(); ++i) {
      sizes[units[i]].push_back(std::abs(residuals[static_cast<Index>(i)]));
    }
    if (sizes.size() < 2 || !residuals.allFinite()) return;
    mean_squares_.resize(std::ssize(sizes));
    Index u = 0;
    for (const auto& [unit, of_unit] : sizes) {
      const auto rows = static_cast<double>(of_unit.size());
      mean_squares_[u++] =
          Eigen::Map<const VectorXd>(of_unit.data(), std::ssize(of_unit))
              .squaredNorm() /
          rows;
      for (const double size : of_unit) {
        weighted_.emplace_back(size, 1.0 / rows);
      }
    }
    std::ranges::sort(weighted_);
  }

  PredictionInterval::Level Level(double coverage) const {
    PredictionInterval::Level level;
    level.coverage = coverage;
    if (weighted_.empty()) return level;
    const auto count = static_cast<double>(mean_squares_.size());
    level.at_least = (count + 1.0) * coverage > count + kRounding;
    level.half_width = Quantile(coverage) * Widening(coverage);
    level.inside = level.outside = level.half_width;
    return level;
  }

 private:
  VectorXd mean_squares_;                            // (units)
  std::vector<std::pair<double, double>> weighted_;  // empty: not known

  // The least size that `share` of the units' weight does not exceed.
  double Quantile(double share) const {
    double left =
        (share - kRounding) * static_cast<double>(mean_squares_.size());
    for (const auto& [size, weight] : weighted_) {
      left -= weight;
      if (left <= 0.0) return size;
    }
    return weighted_.back().first;
  }

  // Student's t over the normal's quantile.
  double Widening(double coverage) const {
    const double upper = 0.5 * (1.0 + coverage);
    return stats::StudentQuantile(upper,
                                  stats::SatterthwaiteDof(mean_squares_)) /
           stats::NormalQuantile(upper);
  }
};

// Mean error of each unit, in their order, and the share of the mean square
// that these means are.
struct UnitMeans {
  VectorXd means;
  double share = 0.0;
};

UnitMeans MeansOfUnits(const VectorXd& residuals,
                       const std::vector<Index>& units) {
  std::map<Index, std::vector<double>> errors;
  for (std::size_t i = 0; i < units.size(); ++i) {
    errors[units[i]].push_back(residuals[static_cast<Index>(i)]);
  }
  UnitMeans found{.means = VectorXd(std::ssize(errors))};
  double squares = 0.0;
  Index unit = 0;
  for (const auto& [code, of_unit] : errors) {
    const Eigen::Map<const VectorXd> values(of_unit.data(),
                                            std::ssize(of_unit));
    found.means[unit++] = values.mean();
    squares += values.squaredNorm() / static_cast<double>(values.size());
  }
  if (squares > 0.0) found.share = found.means.squaredNorm() / squares;
  return found;
}

// By how much the mean square of the next `later` of a first-order
// autoregression about the mean of `n` of them is above that of these n, each
// about the mean of the others.
double MeanSquareToCome(double memory, Index n, Index later) {
  const auto number = static_cast<double>(n);
  double of_mean = 1.0 / number;
  for (Index lag = 1; lag < n; ++lag) {
    of_mean += 2.0 * (1.0 - static_cast<double>(lag) / number) / number *
               std::pow(memory, static_cast<double>(lag));
  }
  double shared = 0.0;
  for (Index next = 0; next < later; ++next) {
    for (Index lag = next + 1; lag <= next + n; ++lag) {
      shared += std::pow(memory, static_cast<double>(lag)) / number;
    }
  }
  const double to_come =
      1.0 + of_mean - 2.0 * shared / static_cast<double>(later);
  const double others = number / (number - 1.0);
  return std::max(1.0, to_come / ((1.0 - of_mean) * others * others));
}

// If the mean errors of neighbouring sessions are correlated, like a
// first-order autoregression, later sessions drift away from the measured ones.
// Then the interval holds until a quarter of the correlation is lost, and for
// at most a fifth of the measured time. It is also made wider, since later
// sessions are further away than the measured ones were from each other. Few
// sessions seldom prove such a correlation, so it is reported unless they
// exclude it.
void FindMemory(const VectorXd& residuals,
                const std::vector<Index>& units,
                PredictionInterval* interval) {
  constexpr double kShared = 0.75;
  constexpr double kStrong = 0.7;
  constexpr double kMost = 0.98;
  constexpr double kMostToCome = 0.9;
  constexpr Index kFewestSessions = 6;
  const UnitMeans found = MeansOfUnits(residuals, units);
  const Index n = found.means.size();
  interval->lag1 = stats::TestSerially({found.means}).lag1.statistic;
  if (n < kFewestSessions || !(found.means.minCoeff() < found.means.maxCoeff()))
    return;
  if (stats::MemoryOf(found.means, stats::kMostMemory) < kStrong) return;
  const double likely = stats::MemoryOf(found.means, 0.0);
  const auto lasts = static_cast<Index>(std::floor(
      std::log(kShared) / std::log(std::clamp(likely, kShared, kMost))));
  interval->good_for = std::clamp(lasts, Index{1}, std::max(Index{1}, n / 5));
  const double wider = std::sqrt(
      1.0 +
      found.share * (MeanSquareToCome(
                         std::min(likely, kMostToCome), n, interval->good_for) -
                     1.0));
  for (PredictionInterval::Level& level : interval->levels) {
    level.half_width *= wider;
    level.inside *= wider;
    level.outside *= wider;
  }
}

// Of those rows alone that are (not) inside of what was trained.
SizesOfUnits SizesWhere(const VectorXd& residuals,
                        const std::vector<Index>& units,
                        const std::vector<bool>& inside,
                        bool wanted) {
  std::vector<Index> rows;
  std::vector<Index> of_rows;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (inside[i] != wanted) continue;
    rows.push_back(static_cast<Index>(i));
    of_rows.push_back(units[i]);
  }
  return {residuals(rows), of_rows};
}

}  // namespace

PredictionInterval::Level UnitIntervalLevel(const VectorXd& residuals,
                                            const std::vector<Index>& units,
                                            double coverage) {
  return SizesOfUnits(residuals, units).Level(coverage);
}

std::optional<PredictionInterval> PredictionIntervalOf(
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
  interval.units = std::ssize(units.labels);
  interval.of_sessions = units.are_sessions;
  if (interval.units < 2) return std::nullopt;
  const VectorXd residuals = ResidualsOf(held, result);
  const std::vector<bool> is_inside = inside ? inside() : std::vector<bool>{};
  const SizesOfUnits all(residuals, codes);
  const SizesOfUnits insides = SizesWhere(residuals, codes, is_inside, true);
  const SizesOfUnits outsides = SizesWhere(residuals, codes, is_inside, false);
  for (const double coverage : PredictionInterval::kCoverages) {
    PredictionInterval::Level level = all.Level(coverage);
    const double in = insides.Level(coverage).half_width;
    const double out = outsides.Level(coverage).half_width;
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
