#include "models/learning/learning_curve.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "data/text.h"
#include "models/study/judgement/units_of_analysis.h"
#include "stats/distributions.h"
#include "stats/indices.h"
#include "stats/not_a_number.h"
#include "stats/random.h"

namespace errmap::models {
namespace {

constexpr Index kMostFolds = 5;
constexpr std::size_t kMostSizes = 7;

// Units of the rows, numbered from 0 without gaps.
struct Units {
  std::string name;
  std::vector<Index> codes;  // (rows)
  Index count = 0;
};

Units UnitsOf(const data::Dataset& dataset, LearnBy by) {
  const bool sessions = by == LearnBy::kSessions;
  if (sessions && dataset.log() == nullptr) {
    throw std::invalid_argument("the data have no sessions to learn by");
  }
  if (!sessions && !dataset.has_groups()) {
    throw std::invalid_argument("the data have no groups to learn by");
  }
  const data::Grouping& grouping =
      sessions ? dataset.log()->sessions : dataset.groups();
  Units units;
  units.name = data::WordFor(grouping);
  units.codes = sessions ? dataset.session_codes() : dataset.groups().codes;
  units.count = stats::Renumber(&units.codes);
  return units;
}

// 2, 3, 4, 6, ... up to all that a fold leaves: steps of about the same ratio.
std::vector<Index> SizesUpTo(Index most) {
  std::set<Index> sizes;
  const double ratio = static_cast<double>(most) / 2.0;
  for (std::size_t i = 0; i < kMostSizes; ++i) {
    sizes.insert(static_cast<Index>(std::lround(
        2.0 * std::pow(ratio, static_cast<double>(i) / (kMostSizes - 1.0)))));
  }
  return {sizes.begin(), sizes.end()};
}

std::vector<Index> RowsOfUnits(const Units& units, const std::set<Index>& of) {
  std::vector<Index> rows;
  for (std::size_t row = 0; row < units.codes.size(); ++row) {
    if (of.contains(units.codes[row])) rows.push_back(static_cast<Index>(row));
  }
  return rows;
}

// How often `size` of a fold's smallest pool can be drawn anew, up to `most`.
Index DifferentDraws(Index pool, Index size, Index most) {
  double ways = 1.0;
  for (Index i = 0; i < std::min(size, pool - size); ++i) {
    ways *= static_cast<double>(pool - i) / static_cast<double>(i + 1);
  }
  constexpr double kHalf = 0.5;  // of rounding
  return ways + kHalf < static_cast<double>(most)
             ? static_cast<Index>(ways + kHalf)
             : most;
}

Holdout MakeHoldout(const Units& units,
                    Index size,
                    Index folds,
                    Index repeats,
                    bool by_sessions,
                    stats::Random* random) {
  Holdout holdout;
  holdout.name = fmt::format("{} of {} ({})", size, units.count, units.name);
  holdout.whole_groups = !by_sessions;
  holdout.whole_sessions = by_sessions;
  const Index smallest_pool = units.count - (units.count + folds - 1) / folds;
  holdout.repeats = DifferentDraws(smallest_pool, size, repeats);
  std::vector<std::set<std::set<Index>>> drawn(static_cast<std::size_t>(folds));
  for (Index repeat = 0; repeat < holdout.repeats; ++repeat) {
    for (Index fold = 0; fold < folds; ++fold) {
      std::set<Index> tested;
      std::vector<Index> pool;
      for (Index unit = 0; unit < units.count; ++unit) {
        if (unit * folds / units.count == fold) {
          tested.insert(unit);
        } else {
          pool.push_back(unit);
        }
      }
      std::set<Index> trained;
      do {  // the same rows again would be the same fit
        random->Shuffle(pool);
        trained = {pool.begin(), pool.begin() + size};
      } while (!drawn[static_cast<std::size_t>(fold)].insert(trained).second);
      holdout.folds.push_back({.train = RowsOfUnits(units, trained),
                               .test = RowsOfUnits(units, tested)});
    }
  }
  return holdout;
}

// The mean square of the residuals of each unit.
VectorXd UnitMeanSquares(const std::vector<Index>& codes,
                         const VectorXd& residuals) {
  std::map<Index, std::pair<double, double>> sums;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    auto& [sum, count] = sums[codes[i]];
    sum += std::pow(residuals[static_cast<Index>(i)], 2);
    count += 1.0;
  }
  VectorXd squares(std::ssize(sums));
  Index at = 0;
  for (const auto& [code, sum] : sums) squares[at++] = sum.first / sum.second;
  return squares;
}

// (draws) The logarithm of the RMSE of each draw of units, over its folds.
VectorXd LogOfDraws(const Holdout& holdout,
                    const HeldOutRows& held,
                    const VectorXd& residuals) {
  const auto draws =
      std::max<std::size_t>(1, static_cast<std::size_t>(holdout.repeats));
  const std::size_t folds = holdout.folds.size() / draws;
  VectorXd squares = VectorXd::Zero(static_cast<Index>(draws));
  VectorXd rows = squares;
  for (std::size_t i = 0; i < held.fold_of.size(); ++i) {
    const auto draw = static_cast<Index>(held.fold_of[i] / folds);
    squares[draw] += std::pow(residuals[static_cast<Index>(i)], 2);
    rows[draw] += 1.0;
  }
  constexpr double kLeast = 1e-300;
  return 0.5 * (squares.cwiseQuotient(rows)).cwiseMax(kLeast).array().log();
}

// The draws' RMSE are averaged as logarithms, so that one from which a map
// explodes is one of several; how they scatter counts with the units. The
// interval is Student's t over units of the logarithm, by the delta method: the
// RMSE is above 0 and skewed.
LearningCurve::Point PointOf(Index size,
                             const VectorXd& squares,
                             const VectorXd& log_of_draws) {
  constexpr double kUpper = 0.95;
  const auto units = static_cast<double>(squares.size());
  LearningCurve::Point point{
      .size = size, .low = stats::kNaN, .high = stats::kNaN};
  point.rmse = std::exp(log_of_draws.mean());
  if (squares.size() < 2) {
    point.relative_error = 1.0;
    return point;
  }
  const double variance =
      (squares.array() - squares.mean()).square().sum() / (units - 1.0);
  point.relative_error =
      0.5 * std::sqrt(variance / units) / std::max(squares.mean(), 1e-300);
  if (const auto draws = static_cast<double>(log_of_draws.size());
      draws > 1.0) {
    const double scatter =
        (log_of_draws.array() - log_of_draws.mean()).square().sum() /
        (draws - 1.0) / draws;
    point.relative_error =
        std::sqrt(std::pow(point.relative_error, 2) + scatter);
  }
  if (squares.size() < 3) return point;
  const double wide = std::exp(stats::StudentQuantile(kUpper, units - 1.0) *
                               point.relative_error);
  point.low = point.rmse / wide;
  point.high = point.rmse * wide;
  return point;
}

LearningCurve CurveOf(const data::Dataset& dataset,
                      const LearningPlan& plan,
                      const ModelResult& model) {
  LearningCurve curve{
      .model = model.name, .why_failed = {}, .points = {}, .law = {}};
  for (std::size_t i = 0; i < plan.sizes.size(); ++i) {
    const HoldoutResult& result = model.holdouts[i];
    if (!result.ok()) {
      if (curve.why_failed.empty()) curve.why_failed = result.why_failed;
      continue;
    }
    const HeldOutRows held = GatherHeldOut(dataset, plan.holdouts[i]);
    UnitsOfAnalysis units;
    const std::vector<Index> codes =
        AssignUnits(plan.holdouts[i], held, &units);
    const VectorXd residuals = ResidualsOf(held, result);
    if (!residuals.allFinite()) continue;
    curve.points.push_back(
        PointOf(plan.sizes[i],
                UnitMeanSquares(codes, residuals),
                LogOfDraws(plan.holdouts[i], held, residuals)));
  }
  std::vector<LearningPoint> points;
  for (const LearningCurve::Point& point : curve.points) {
    if (!(point.rmse > 0.0)) continue;
    points.push_back({.size = static_cast<double>(point.size),
                      .rmse = point.rmse,
                      .relative_error = point.relative_error});
  }
  if (points.size() >= 2) {
    curve.law.emplace(points, static_cast<double>(plan.num_units));
  }
  return curve;
}

}  // namespace

LearningPlan PlanLearning(const data::Dataset& dataset,
                          LearnBy by,
                          Index repeats,
                          std::uint64_t seed) {
  constexpr Index kFewestUnits = 4;
  const Units units = UnitsOf(dataset, by);
  if (units.count < kFewestUnits) {
    throw std::invalid_argument(
        fmt::format("a learning curve needs at least {}; the data have {}",
                    data::CountText(kFewestUnits, units.name),
                    units.count));
  }
  const Index folds = std::min(units.count, kMostFolds);
  const Index largest = (units.count + folds - 1) / folds;
  LearningPlan plan{.unit = units.name,
                    .num_units = units.count,
                    .sizes = SizesUpTo(units.count - largest),
                    .holdouts = {}};
  stats::Random random(seed);
  for (const Index size : plan.sizes) {
    plan.holdouts.push_back(MakeHoldout(
        units, size, folds, repeats, by == LearnBy::kSessions, &random));
  }
  return plan;
}

std::vector<LearningCurve> CurvesOf(const data::Dataset& dataset,
                                    const LearningPlan& plan,
                                    const StudyResult& study) {
  std::vector<LearningCurve> curves;
  for (const ModelResult& model : study.models) {
    curves.push_back(CurveOf(dataset, plan, model));
  }
  return curves;
}

}  // namespace errmap::models
