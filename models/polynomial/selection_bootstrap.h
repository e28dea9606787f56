#pragma once

#include <functional>
#include <vector>

#include "models/error_model.h"
#include "models/polynomial/term_dictionary.h"

namespace errmap::models {

/// Chooses terms of a problem (columns).
using ChooseTerms = std::function<std::vector<Eigen::Index>(
    const fitting::SelectionProblem& problem)>;

/// Reports the share of `report->bootstrap` repetitions in which each candidate
/// is chosen, for `chosen` and for those that are not. Each repetition draws
/// rows with replacement, or whole groups where there are groups: those of
/// `units` (r); draws enter as weights. NaN if interrupted.
void ReportInclusion(const TermDictionary& dictionary,
                     const DesignRows& rows,
                     const std::vector<Eigen::Index>& units,
                     const std::vector<Eigen::Index>& chosen,
                     const ChooseTerms& choose,
                     const FitContext& context,
                     RegressionReport* report);

}  // namespace errmap::models
