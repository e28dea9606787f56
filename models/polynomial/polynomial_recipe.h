#pragma once

#include <memory>

#include "models/error_model.h"
#include "models/model_spec.h"

namespace errmap::models {

/// The recipes of constants and polynomials: zero, mean, poly:position,
/// poly:temperature, poly:eq7, poly:eq8, poly:eq9, poly:full, poly:stepwise.
/// Null where `spec.type` is none of them. Throws std::invalid_argument on
/// options that the model does not have or that are out of range.
std::unique_ptr<ModelRecipe> MakePolynomialRecipe(const ModelSpec& spec);

}  // namespace errmap::models
