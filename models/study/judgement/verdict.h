#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/study/judgement/choice.h"
#include "models/study/judgement/holdout_comparison.h"
#include "models/study/study.h"

namespace errmap::models {

/// The conclusion from one hold-out.
struct Verdict {
  std::string holdout;
  Choice choice = Choice::kBaseline;
  std::size_t best = 0;  // lowest RMSE: index into StudyResult::models
  /// The model that the best one is compared with: the best of another class,
  /// never a blend, or the best baseline if there is none.
  std::optional<std::size_t> rival;
  std::optional<std::size_t> best_baseline;  // by RMSE
  /// kPolynomial, kNeural, kGiven: if the best is better than its rival and
  /// than the best baseline. kBaseline: if the best baseline loses at most the
  /// margin to the best of all others. kNoPracticalDifference: if the best
  /// polynomial and the best net lose at most the margin to each other.
  Confidence confidence = Confidence::kOutOfReach;

  bool established() const { return confidence == Confidence::kEstablished; }
};

/// Each model's error among neighbours and its error on unseen groups.
struct InterpolationGap {
  struct Row {
    std::size_t model = 0;
    double neighbours_rmse = 0.0;
    double unseen_rmse = 0.0;
    double ratio() const { return unseen_rmse / neighbours_rmse; }
    /// True if neighbours flatter: the error on unseen groups is twice as
    /// large.
    bool flatters() const { return ratio() >= kFlatteringRatio; }
  };
  static constexpr double kFlatteringRatio = 2.0;

  std::size_t neighbours = 0;  // index of the hold-out
  std::size_t unseen = 0;
  std::vector<Row> rows;  // models judged in both
};

/// Judges one hold-out in which at least one model could be judged.
Verdict JudgeHoldout(const HoldoutComparison& comparison,
                     const StudyResult& study,
                     double indifference);

/// Returns nothing unless both kinds of hold-out are present.
std::optional<InterpolationGap> MeasureGap(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons);

}  // namespace errmap::models
