#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "models/study/judgement/confidence.h"
#include "models/study/judgement/units_of_analysis.h"
#include "models/study/study.h"
#include "stats/comparison/paired_comparison.h"
#include "stats/eigen.h"
#include "stats/not_a_number.h"

namespace errmap::models {

/// A model and the share of repeats in which it had the lowest error.
struct WinShare {
  std::string model;
  double share = stats::kNaN;
};

/// All models with results in one hold-out, compared with each other.
struct HoldoutComparison {
  std::string holdout;
  UnitsOfAnalysis units;
  std::vector<std::size_t> models;  // (m) index into StudyResult::models
  MatrixXd unit_rmse;               // (units x m) target's unit
  stats::Comparison tests;          // its indices refer to `models`
  Obstacle obstacle;                // to establishing any difference
  std::vector<Confidence> differ;   // (pairs) as tests.pairs: if they differ
  std::vector<WinShare> wins;       // falling; empty without repeats

  /// Returns the index of a study's model in `models`, or nothing if it failed.
  std::optional<Index> PlaceOf(std::size_t model) const;
  /// Returns the 1-based tier of a study's model, 0 if it failed.
  int TierOf(std::size_t model) const;
  /// Checks whether one model of the study has a lower error than another. Both
  /// must have results.
  Confidence ThatItIsBetter(std::size_t model, std::size_t than) const;
  /// Checks whether the RMSE of one model exceeds that of another by at most
  /// `margin`. Both must have results.
  Confidence ThatItLosesAtMost(double margin,
                               std::size_t model,
                               std::size_t than) const;
};

/// Compares the models of a study in each hold-out, on one mean squared
/// residual per unit (stats/comparison/paired_comparison.h). Units are the
/// sessions or groups of the held-out rows, or blocks of them in order.
/// `indifference` (target's unit) is the difference in RMSE that does not
/// matter.
std::vector<HoldoutComparison> CompareHoldouts(
    const data::Dataset& dataset,
    const std::vector<Holdout>& holdouts,
    const StudyResult& study,
    double indifference,
    std::uint64_t seed);

/// Returns the hold-out for predicted errors, as an index into `holdouts`. Even
/// two sessions show more about a third one than any number of groups within
/// them. Nothing if all failed.
std::optional<std::size_t> StrictestHoldout(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons);

/// Returns the hold-out that chooses a map. With fewer than
/// kFewestSessionsToDecide sessions a fold lacks too much of the data, and
/// groups distinguish maps better.
std::optional<std::size_t> DecisiveHoldout(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons);

/// Returns the hold-out that predicts later sessions; null if there is none.
const HoldoutComparison* ForwardOverSessions(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons);

}  // namespace errmap::models
