#pragma once

#include <string>
#include <string_view>

#include "models/study/fit_outcome.h"

namespace errmap::models {

/// Returns the bytes of an outcome's members in this build's layout, preceded
/// by the SHA-256 of these bytes and `key`.
std::string FitToBytes(std::string_view key, const FitOutcome& outcome);

/// Reads the bytes of FitToBytes; the model predicts the same bits. Throws
/// data::InputError if they are damaged or have another key or layout.
FitOutcome FitFromBytes(std::string_view key, std::string_view bytes);

}  // namespace errmap::models
