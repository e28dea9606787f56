#include "models/study/judgement/judgement.h"

namespace errmap::models {

Judgement JudgeStudy(const data::Dataset& dataset,
                     const std::vector<Holdout>& holdouts,
                     const StudyResult& study,
                     const JudgeOptions& options) {
  Judgement judgement;
  judgement.comparisons = CompareHoldouts(
      dataset, holdouts, study, options.indifference, options.seed);
  for (const HoldoutComparison& comparison : judgement.comparisons) {
    judgement.verdicts.push_back(
        comparison.models.empty()
            ? std::nullopt
            : std::optional(
                  JudgeHoldout(comparison, study, options.indifference)));
  }
  judgement.gap = MeasureGap(holdouts, study, judgement.comparisons);
  judgement.recommendation =
      Recommend(dataset, holdouts, study, judgement.comparisons, options);
  for (const ModelResult& model : study.models) {
    std::vector<GoalJudgement>& goals = judgement.goals.emplace_back();
    for (const HoldoutResult& result : model.holdouts) {
      goals.push_back(JudgeGoal(options.goal,
                                result.test,
                                result.ok() && !study.interrupted,
                                options.rezeroed));
    }
  }
  return judgement;
}

}  // namespace errmap::models
