#pragma once

#include <string>
#include <string_view>

#include "models/study/fit_outcome.h"

namespace errmap::models {

/// The bytes of an outcome's members, as this build of the program has them,
/// behind the SHA-256 of them and `key`.
std::string FitToBytes(std::string_view key, const FitOutcome& outcome);

/// What FitToBytes wrote; its model predicts the same bits. Throws
/// data::InputError where the bytes are damaged, of another key or layout.
FitOutcome FitFromBytes(std::string_view key, std::string_view bytes);

}  // namespace errmap::models
