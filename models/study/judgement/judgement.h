#pragma once

#include <optional>
#include <vector>

#include "models/study/judgement/recommendation.h"
#include "models/study/judgement/verdict.h"

namespace errmap::models {

/// The judgement from all hold-outs together.
struct Judgement {
  std::vector<HoldoutComparison> comparisons;    // one per hold-out
  std::vector<std::optional<Verdict>> verdicts;  // empty if all failed
  std::optional<InterpolationGap> gap;  // if both kinds of hold-out exist
  std::optional<Recommendation> recommendation;
  std::vector<std::vector<GoalJudgement>> goals;  // (models x hold-outs)
};

/// Judges a study: each hold-out alone, then the map to use (Recommend).
Judgement JudgeStudy(const data::Dataset& dataset,
                     const std::vector<Holdout>& holdouts,
                     const StudyResult& study,
                     const JudgeOptions& options);

}  // namespace errmap::models
