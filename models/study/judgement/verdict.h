#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/study/judgement/choice.h"
#include "models/study/judgement/holdout_comparison.h"
#include "models/study/study.h"

namespace errmap::models {

/// What one hold-out says.
struct Verdict {
  std::string holdout;
  Choice choice = Choice::kBaseline;
  std::size_t best = 0;  // lowest RMSE: index into StudyResult::models
  /// The best model of another class, or the best baseline where the table has
  /// no other class: what the choice was made against.
  std::optional<std::size_t> rival;
  std::optional<std::size_t> best_baseline;  // by RMSE
  /// kPolynomial, kNeural, kGiven: that the best is better than its rival and
  /// than the best baseline. kBaseline: that the best baseline loses at most
  /// the margin to the best of all others. kNoPracticalDifference: that the
  /// best polynomial and the best net lose at most the margin to each other.
  Confidence confidence = Confidence::kOutOfReach;

  bool established() const { return confidence == Confidence::kEstablished; }
};

/// The error of each model among neighbours beside that on unseen groups.
struct InterpolationGap {
  struct Row {
    std::size_t model = 0;
    double neighbours_rmse = 0.0;
    double unseen_rmse = 0.0;
    double ratio() const { return unseen_rmse / neighbours_rmse; }
    /// The first flatters: unseen groups are met with twice the error.
    bool flatters() const { return ratio() >= kFlatteringRatio; }
  };
  static constexpr double kFlatteringRatio = 2.0;

  std::size_t neighbours = 0;  // index of the hold-out
  std::size_t unseen = 0;
  std::vector<Row> rows;  // models that both could judge
};

/// Judges one hold-out under which some model could be judged.
Verdict JudgeHoldout(const HoldoutComparison& comparison,
                     const StudyResult& study,
                     double indifference);

/// Nothing where one of both kinds of hold-out is missing.
std::optional<InterpolationGap> MeasureGap(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons);

}  // namespace errmap::models
