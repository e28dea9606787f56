#pragma once

#include <memory>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/study/study.h"

namespace errmap::models {

/// Records in a map fitted to `dataset` its training range and rows. Both stay
/// empty if MakeApplicability and MakeLearntRows return nothing.
void AddExperience(const data::Dataset& dataset, FittedModel* fitted);

/// Gives a map fitted to `dataset` its interval and held-out errors, from the
/// predictions of `holdout`'s held-out rows. They stay empty if
/// PredictionIntervalOf returns nothing.
void AddUncertainty(const data::Dataset& dataset,
                    const Holdout& holdout,
                    const HoldoutResult& result,
                    FittedModel* fitted);

/// Does the same for a map fitted outside a study: runs its recipe under
/// StrictestDefaultHoldout(dataset). The interval stays empty if a fold fails
/// or was interrupted. Throws std::invalid_argument if the data allow no such
/// hold-out, std::bad_alloc if a fold lacks memory.
void AddUncertainty(const data::Dataset& dataset,
                    std::unique_ptr<ModelRecipe> recipe,
                    StudyOptions options,
                    FittedModel* fitted);

}  // namespace errmap::models
