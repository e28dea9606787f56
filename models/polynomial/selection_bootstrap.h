#pragma once

#include <functional>
#include <vector>

#include "models/error_model.h"
#include "models/polynomial/term_dictionary.h"

namespace errmap::models {

/// Chooses terms of a problem (columns).
using ChooseTerms = std::function<std::vector<Index>(
    const fitting::RegressionProblem& problem)>;

/// Reports the share of `repetitions` in which each candidate is chosen, for
/// `chosen` (as lines of the coefficient table) and for the excluded ones. Each
/// repetition draws rows with replacement, or whole groups `units` (r) if there
/// are any; the draws become weights. NaN if interrupted.
void ReportInclusion(const TermDictionary& dictionary,
                     const DesignRows& rows,
                     const std::vector<Index>& units,
                     const std::vector<Index>& chosen,
                     int repetitions,
                     const ChooseTerms& choose,
                     const FitContext& context,
                     RegressionRecord* report);

}  // namespace errmap::models
