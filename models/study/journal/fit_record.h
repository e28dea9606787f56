#pragma once

#include <string>
#include <string_view>

#include "models/study/fit_outcome.h"

namespace errmap::models {

/// Returns the bytes of an outcome's members in this build's layout, preceded
/// by the SHA-256 of these bytes and `key`.
std::string FitToBytes(std::string_view key, const FitOutcome& outcome);

/// Reads what FitToBytes returned; the model predicts exactly the same values.
/// Throws data::InputError if the bytes are damaged or have another key or
/// layout.
FitOutcome FitFromBytes(std::string_view key, std::string_view bytes);

}  // namespace errmap::models
