#pragma once

#include <string>
#include <string_view>

#include "models/study/fit_outcome.h"
#include "models/study/journal/fit_label.h"

namespace errmap::models {

/// An outcome as a text of JSON without a line break: base64 of the bytes of
/// its members, as this build of the program has them.
std::string FitToText(const FitOutcome& outcome);

/// What FitToText wrote; its model predicts the same bits. Throws
/// data::InputError where the text is not of this version.
FitOutcome FitFromText(std::string_view text);

/// The same for a label.
std::string LabelToText(const FitLabel& label);
FitLabel LabelFromText(std::string_view text);

}  // namespace errmap::models
