#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "models/error_model.h"

namespace errmap::models {

/// Returns the path in "file:model.json"; "" for any other SPEC.
std::string FileOfSpec(std::string_view spec);

/// Returns a recipe for "file:model.json", an existing map that is tested
/// unchanged, without a fit; null if `spec` does not begin with "file:". Its
/// Fit throws std::invalid_argument if the data lack an input of the map, or if
/// a unit differs from the map's. Throws data::InputError if the file is
/// unreadable or not a model file.
std::unique_ptr<ModelRecipe> MakeFileRecipe(std::string_view spec);

}  // namespace errmap::models
