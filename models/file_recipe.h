#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "models/error_model.h"

namespace errmap::models {

/// The path in "file:model.json"; "" of any other SPEC.
std::string FileOfSpec(std::string_view spec);

/// "file:model.json": an existing map, judged as it is; nothing is fitted.
/// Returns null where `spec` does not begin with "file:". Its Fit throws
/// std::invalid_argument where the data lack an input of the map or measure
/// target or input in another unit. Throws data::InputError where the file
/// cannot be read or is no model file.
std::unique_ptr<ModelRecipe> MakeFileRecipe(std::string_view spec);

}  // namespace errmap::models
