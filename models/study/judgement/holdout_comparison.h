#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "models/study/judgement/confidence.h"
#include "models/study/judgement/units_of_analysis.h"
#include "models/study/study.h"
#include "stats/comparison/paired_comparison.h"

namespace errmap::models {

/// A model and the share of the repeats in which it had the lowest error.
struct WinShare {
  std::size_t model = 0;  // index into StudyResult::models
  double share = 0.0;
};

/// All models that could be judged under one hold-out, against each other.
struct HoldoutComparison {
  std::string holdout;
  UnitsOfAnalysis units;
  std::vector<std::size_t> models;  // (m) index into StudyResult::models
  Eigen::MatrixXd unit_rmse;        // (units x m) target's unit
  stats::Comparison tests;          // its indices count `models`
  Obstacle obstacle;                // to establishing any difference
  std::vector<Confidence> differ;   // (pairs) as tests.pairs: that they do
  std::vector<WinShare> wins;       // falling; empty without repeats

  /// Place of a model of the study in `models`, or nothing if it failed.
  std::optional<Eigen::Index> PlaceOf(std::size_t model) const;
  /// 1-based tier of a model of the study, 0 if it failed.
  int TierOf(std::size_t model) const;
  /// That one model of the study has less error than another. Both must have
  /// been judged.
  Confidence ThatItIsBetter(std::size_t model, std::size_t than) const;
  /// That one model of the study has at most `margin` more RMSE than another.
  /// Both must have been judged.
  Confidence ThatItLosesAtMost(double margin,
                               std::size_t model,
                               std::size_t than) const;
};

/// Compares the models of a study hold-out by hold-out, on one mean squared
/// residual per unit (stats/comparison/paired_comparison.h): units are the
/// sessions or groups of the held-out rows, or blocks of them in order.
/// `indifference` (target's unit) is the difference in RMSE that never matters.
std::vector<HoldoutComparison> CompareHoldouts(
    const data::Dataset& dataset,
    const std::vector<Holdout>& holdouts,
    const StudyResult& study,
    double indifference,
    std::uint64_t seed);

}  // namespace errmap::models
