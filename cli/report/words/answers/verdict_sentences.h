#pragma once

#include <string>

#include "cli/report/words/answers/component_numbers.h"

namespace errmap::report {

/// Says which model has the lowest error under a hold-out, and how certain that
/// is.
std::string VerdictSentence(const ComponentNumbers& component,
                            const models::VerdictRecord& verdict);

/// Says how much smaller the error among neighbours is, for a component with a
/// gap; "" if it is not smaller.
std::string GapSentence(const ComponentNumbers& component);

/// Says how much noise a model learns, for a model that was tested for
/// memorisation.
std::string MemorisationSentence(const ModelRecord& model);

}  // namespace errmap::report
