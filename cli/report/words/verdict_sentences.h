#pragma once

#include <string>

#include "cli/report/words/component_numbers.h"

namespace errmap::report {

/// Which model has the lowest error under a hold-out, and how surely.
std::string VerdictSentence(const ComponentNumbers& component,
                            const models::VerdictRecord& verdict);

/// What to use, of a component with a recommendation.
std::string AdviceSentence(const ComponentNumbers& component);

/// The best baseline's error beside the recommended map's: the difference, its
/// interval, and what it lacks where it is not established.
std::string AgainstBaselineSentence(const ComponentNumbers& component);

/// How much neighbours flatter, of a component with a gap; "" where they do
/// not.
std::string GapSentence(const ComponentNumbers& component);

/// How much noise a model learns, of one whose memorisation was looked at.
std::string MemorisationSentence(const ModelRecord& model);

}  // namespace errmap::report
