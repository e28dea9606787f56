#pragma once

#include <memory>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/study/study.h"

namespace errmap::models {

/// Gives a map that was fitted to `dataset` where it was trained, and on which
/// rows; they stay empty where MakeApplicability and MakeLearntRows have
/// nothing.
void AddExperience(const data::Dataset& dataset, FittedModel* fitted);

/// Gives a map that was fitted to `dataset` what it may promise, from its
/// predictions of `holdout`'s held-out rows: the interval and the errors behind
/// it, which stay empty where PromiseOf has nothing.
void AddPromise(const data::Dataset& dataset,
                const Holdout& holdout,
                const HoldoutResult& result,
                FittedModel* fitted);

/// The same for a map fitted alone: its recipe is run under
/// StrictestDefaultHoldout(dataset). Nothing where a fold fails or was
/// interrupted. Throws std::invalid_argument where the data allow
/// no such hold-out, std::bad_alloc where a fold finds not enough memory.
void AddPromise(const data::Dataset& dataset,
                std::unique_ptr<ModelRecipe> recipe,
                StudyOptions options,
                FittedModel* fitted);

}  // namespace errmap::models
