#pragma once

#include <string>

#include "cli/report/words/answers/component_numbers.h"

namespace errmap::report {

/// Which model has the lowest error under a hold-out, and how surely.
std::string VerdictSentence(const ComponentNumbers& component,
                            const models::VerdictRecord& verdict);

/// How much neighbours flatter, of a component with a gap; "" where they do
/// not.
std::string GapSentence(const ComponentNumbers& component);

/// How much noise a model learns, of one whose memorisation was looked at.
std::string MemorisationSentence(const ModelRecord& model);

}  // namespace errmap::report
