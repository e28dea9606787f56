#pragma once

#include <string>

#include "cli/report/text/answers/component_numbers.h"

namespace errmap::report {

/// Returns a sentence on the model with the lowest error under a hold-out, and
/// how certain that is.
std::string VerdictSentence(const ComponentNumbers& component,
                            const models::VerdictRecord& verdict);

/// For a component with a gap, returns how much smaller the error among
/// neighbours is; "" if it is not smaller.
std::string GapSentence(const ComponentNumbers& component);

/// For a model that was tested for memorisation, returns how much noise it
/// learns.
std::string MemorisationSentence(const ModelRecord& model);

}  // namespace errmap::report
