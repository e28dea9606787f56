#pragma once

#include <memory>

#include "models/error_model.h"
#include "models/model_spec.h"

namespace errmap::models {

/// blend: the weighted average of candidates (family x view x terms, each at
/// its best penalty, and a net), with weights from the inner hold-outs of the
/// training rows alone. One choice among near-equals is a gamble; averages of
/// maps that see the inputs differently are not. Null where `spec` is of
/// another model. Throws std::invalid_argument on options that it does not
/// have.
std::unique_ptr<ModelRecipe> MakeBlendRecipe(const ModelSpec& spec);

}  // namespace errmap::models
