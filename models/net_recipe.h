#pragma once

#include <memory>

#include "models/error_model.h"
#include "models/model_spec.h"

namespace errmap::models {

/// The recipe of a net (net_trainer.h), or null where `spec.type` is another
/// model. Throws std::invalid_argument on options that are unknown or out of
/// range.
std::unique_ptr<ModelRecipe> MakeNetRecipe(const ModelSpec& spec);

}  // namespace errmap::models
