#include "models/uncertainty/add_uncertainty.h"

#include <new>
#include <utility>
#include <vector>

#include "models/sensors/applicability.h"
#include "models/study/study_defaults.h"
#include "models/uncertainty/held_out_errors.h"
#include "models/uncertainty/learnt_rows.h"
#include "models/uncertainty/unit_interval.h"

namespace errmap::models {

void AddExperience(const data::Dataset& dataset, FittedModel* fitted) {
  if (auto trained = MakeApplicability(*fitted, dataset)) {
    fitted->applicability =
        std::make_shared<const Applicability>(std::move(*trained));
  }
  if (auto learnt = MakeLearntRows(*fitted, dataset)) {
    fitted->learnt = std::make_shared<const LearntRows>(std::move(*learnt));
  }
}

void AddUncertainty(const data::Dataset& dataset,
                    const Holdout& holdout,
                    const HoldoutResult& result,
                    FittedModel* fitted) {
  fitted->interval = PredictionIntervalOf(dataset, holdout, result, [&] {
    return InsideOfFolds(*fitted, dataset, holdout);
  });
  if (auto errors = HeldOutErrorsOf(dataset, holdout, result, fitted->inputs)) {
    fitted->held_out =
        std::make_shared<const HeldOutErrors>(std::move(*errors));
  }
}

void AddUncertainty(const data::Dataset& dataset,
                    std::unique_ptr<ModelRecipe> recipe,
                    StudyOptions options,
                    FittedModel* fitted) {
  const Holdout holdout =
      MakeHoldout(stats::ParseHoldout(StrictestDefaultHoldout(dataset)),
                  dataset,
                  options.seed);
  options.fit_all_rows = false;
  std::vector<std::unique_ptr<ModelRecipe>> recipes;
  recipes.push_back(std::move(recipe));
  const StudyResult study = RunStudy(dataset, {holdout}, recipes, options);
  if (study.interrupted) return;
  if (study.short_of_memory > 0) throw std::bad_alloc();
  AddUncertainty(
      dataset, holdout, study.models.front().holdouts.front(), fitted);
}

}  // namespace errmap::models
