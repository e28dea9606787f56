#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/study/judgement/choice.h"
#include "models/study/judgement/goal.h"
#include "models/study/judgement/holdout_comparison.h"
#include "models/study/study.h"

namespace errmap::models {

/// The map to use.
struct Recommendation {
  /// The strictest that was measured: every figure, goal and promise is its.
  std::size_t holdout = 0;
  std::size_t decided_by = 0;  // the hold-out that the map was chosen by
  std::size_t model = 0;
  Choice choice = Choice::kBaseline;
  /// By RMSE; where there is one unit only, the models within the margin.
  std::vector<std::size_t> first_tier;
  std::size_t best_baseline = 0;  // by RMSE, under that hold-out
  bool has_baseline = false;
  /// That the map is better than the best baseline; of a baseline, that it
  /// loses at most the margin to the best of all others.
  Confidence against_baseline = Confidence::kOutOfReach;
  /// That it loses at most the margin to the lowest error of its tier.
  Confidence within_tier = Confidence::kOutOfReach;
  /// Where a blend is to be used, the simplest single map of the first tier,
  /// or the best one where there is none.
  std::optional<std::size_t> single;
  /// Of a single map, the blend than which separate days prove it better.
  std::optional<std::size_t> proven_better_than;
  /// Of a simple map, the hold-out where the blend errs more than twice as
  /// much; "" where it does not.
  std::string fails_in;
  /// Predictions without a map that were better than every map, if any.
  std::optional<std::size_t> better_but_no_map;
  /// Of the held-out rows, those with an input of the model outside what the
  /// fold trained on (0 to 1).
  double extrapolated_share = 0.0;
};

/// Which map is recommended.
enum class Choose {
  kAuto,   // the blend, unless a baseline errs less or a map is proven better
  kBest,   // the lowest error
  kBlend,  // the blend wherever there is one
};

std::string_view ToString(Choose choose);  // "auto", "best", "blend"

/// What a map is to have besides little error.
enum class Prefer {
  kLeastError,
  kSmall,  // the cheapest map that loses at most the margin to the one chosen
};
std::string_view ToString(Prefer prefer);  // "least-error", "small"

struct JudgeOptions {
  /// The difference in RMSE that never matters; target's unit, at least 0.
  double indifference = 0.0;
  double goal = GoalJudgement::kNaN;  // target's unit; NaN: none
  std::uint64_t seed = 1;
  Choose choose = Choose::kAuto;
  Prefer prefer = Prefer::kLeastError;
};

/// Rows that a recommendation asks for: a parabola goes through three whatever
/// they are.
inline constexpr Eigen::Index kFewestRowsToRecommend = 12;

/// The map to use, or nothing where no map could be judged: too few rows, or no
/// hold-out with a fit of every fold.
///
/// What is promised follows the first hold-out of two or more whole sessions,
/// else of whole unseen groups, else of another file, else of blocks, else the
/// first; the map is chosen by the same, but by fewer than
/// kFewestSessionsToDecide sessions only where nothing else is. Where there is
/// a blend it is recommended, unless the best baseline's RMSE is lower, and its
/// typical error in later sessions where these were foretold (forward:K), or a
/// single map is established to be better by separate sessions, or a simple one
/// (a baseline, a plane) typically errs less than half as much by the first of
/// these hold-outs or in later sessions. Else the
/// simplest map of the first tier: fewest sensors (data::IsSensor),
/// then fewest parameters, then the lower RMSE; the simplest baseline where one
/// is there: nothing better is known. Whatever is chosen so must be worth its
/// sensors by what is promised (BetterWithoutSensors), else the best baseline
/// without any is recommended.
std::optional<Recommendation> Recommend(
    const data::Dataset& dataset,
    const std::vector<Holdout>& holdouts,
    const StudyResult& study,
    const std::vector<HoldoutComparison>& comparisons,
    const JudgeOptions& options);

/// Inputs of the model that are sensors (data::IsSensor), in its order.
std::vector<std::string> SensorsOf(const FittedModel& fitted);

}  // namespace errmap::models
