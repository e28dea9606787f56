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
#include "stats/not_a_number.h"

namespace errmap::models {

/// The recommended map.
struct Recommendation {
  /// The strictest hold-out: source of all errors, goals and intervals.
  std::size_t holdout = 0;
  std::size_t decided_by = 0;  // the hold-out that chose the map
  std::size_t model = 0;
  Choice choice = Choice::kBaseline;
  /// By RMSE; with only one unit, the models within the margin.
  std::vector<std::size_t> first_tier;
  std::size_t best_baseline = 0;  // by RMSE, under that hold-out
  bool has_baseline = false;
  /// Whether the map is better than the best baseline. For a baseline: whether
  /// it is at most the margin worse than the best other model.
  Confidence against_baseline = Confidence::kOutOfReach;
  /// If a blend is recommended: the single map of lowest error.
  std::optional<std::size_t> single;
  /// For a single map: the blend that it beats, as established by separate
  /// days.
  std::optional<std::size_t> proven_better_than;
  /// For a simple map: the hold-out in which the blend has more than twice its
  /// error; "" if there is none.
  std::string fails_in;
  /// Predictions without a map that beat every map, if any.
  std::optional<std::size_t> better_but_no_map;
  /// Share of held-out rows (0 to 1) with an input of the model outside the
  /// fold's training range.
  double extrapolated_share = 0.0;
};

/// Which map is recommended.
enum class Choose {
  kAuto,   // the blend, unless a baseline errs less or a map is proven better
  kBest,   // the lowest error
  kBlend,  // the blend if there is one
};

std::string_view ToString(Choose choose);  // "auto", "best", "blend"

/// Criteria besides the lowest error.
enum class Prefer {
  kLeastError,
  kSmall,  // the cheapest map that loses at most the margin to the one chosen
};
std::string_view ToString(Prefer prefer);  // "least-error", "small"

struct JudgeOptions {
  /// The difference in RMSE that does not matter; target's unit, at least 0.
  double indifference = 0.0;
  double goal = stats::kNaN;  // target's unit; NaN: none
  std::uint64_t seed = 1;
  Choose choose = Choose::kAuto;
  Prefer prefer = Prefer::kLeastError;
  bool rezeroed = false;  // the study's errors are those of re-zeroed maps
};

/// Fewest rows for a recommendation: a parabola fits any three rows
/// exactly.
inline constexpr Index kFewestRowsToRecommend = 12;

/// Returns the map to use, or nothing if no map could be judged: too few rows,
/// or no hold-out with a fit of every fold.
///
/// The error comes from the first of these hold-outs: at least two whole
/// sessions, whole unseen groups, another file, blocks, any other. The same
/// hold-out chooses the map, unless it has fewer than kFewestSessionsToDecide
/// sessions and there is another one.
///
/// By default a blend is recommended, if there is one, unless one of these is
/// better:
/// - a baseline with lower RMSE (and lower typical error in later sessions, if
///   forward:K predicted these);
/// - a single map, established as better by separate sessions;
/// - a simple map (a baseline, a plane) with less than half the typical error,
///   in the first hold-out or in later sessions.
///
/// Without a blend it is a baseline of the first tier, since nothing is known
/// to be better. A tier without a baseline gives its simplest map: fewest
/// sensors (data::IsReadBySensor), then fewest parameters, then lowest RMSE.
///
/// If the map is not worth its sensors (BetterWithoutSensors), the best
/// baseline without sensors is recommended instead.
std::optional<Recommendation> Recommend(
    const data::Dataset& dataset,
    const std::vector<Holdout>& holdouts,
    const StudyResult& study,
    const std::vector<HoldoutComparison>& comparisons,
    const JudgeOptions& options);

/// Returns the model's inputs that are sensors (data::IsReadBySensor), in
/// order.
std::vector<std::string> SensorsOf(const FittedModel& fitted);

}  // namespace errmap::models
