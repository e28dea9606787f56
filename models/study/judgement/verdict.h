#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/study/judgement/choice.h"
#include "models/study/judgement/holdout_comparison.h"
#include "models/study/study.h"
#include "stats/not_a_number.h"

namespace errmap::models {

/// The conclusion from one hold-out.
struct Verdict {
  std::string holdout;
  Choice choice = Choice::kBaseline;
  std::size_t best = 0;  // lowest RMSE: index into StudyResult::models
  /// The model with which the best one is compared: the best of another class,
  /// never a blend, or the best baseline if there is none.
  std::optional<std::size_t> rival;
  std::optional<std::size_t> best_baseline;  // by RMSE
  /// kPolynomial, kNeural, kGiven: if the best is better than its rival and
  /// than the best baseline. kBaseline: if the best baseline is at most the
  /// margin worse than the best other model. kNoPracticalDifference: if the
  /// best polynomial and the best net differ by at most the margin.
  Confidence confidence = Confidence::kOutOfReach;

  bool established() const { return confidence == Confidence::kEstablished; }
};

/// Each model's error among neighbours and its error on unseen groups.
struct InterpolationGap {
  struct Row {
    std::string model;
    double neighbours_rmse = stats::kNaN;
    double unseen_rmse = stats::kNaN;
    double ratio = stats::kNaN;  // unseen_rmse / neighbours_rmse
    bool flatters = false;       // the ratio is at least 2
  };

  std::string neighbours;  // the hold-outs
  std::string unseen;
  std::string warning = {};      // left to the caller
  std::vector<Row> models = {};  // judged in both
};

/// Judges one hold-out in which at least one model has results.
Verdict JudgeHoldout(const HoldoutComparison& comparison,
                     const StudyResult& study,
                     double indifference);

/// Returns nothing unless both kinds of hold-out are present.
std::optional<InterpolationGap> MeasureGap(
    const std::vector<Holdout>& holdouts,
    const StudyResult& study,
    const std::vector<HoldoutComparison>& comparisons);

}  // namespace errmap::models
