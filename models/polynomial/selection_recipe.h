#pragma once

#include <memory>

#include "models/error_model.h"
#include "models/model_spec.h"

namespace errmap::models {

/// The recipes that choose or shrink the terms of a polynomial, or read them:
/// poly:stepwise, poly:best, poly:ridge, poly:lasso, poly:formula=... Null
/// where `spec` is none of them. Throws std::invalid_argument on options that
/// the model does not have, that are out of range or that contradict.
std::unique_ptr<ModelRecipe> MakeSelectionRecipe(const ModelSpec& spec);

std::unique_ptr<ModelRecipe> MakeStepwiseRecipe(const ModelSpec& spec);
std::unique_ptr<ModelRecipe> MakeBestSubsetRecipe(const ModelSpec& spec);
std::unique_ptr<ModelRecipe> MakePenalizedRecipe(const ModelSpec& spec);
std::unique_ptr<ModelRecipe> MakeFormulaRecipe(const ModelSpec& spec);

}  // namespace errmap::models
