#pragma once

#include <functional>
#include <vector>

#include "models/error_model.h"
#include "models/polynomial/term_dictionary.h"

namespace errmap::models {

/// Chooses terms of a problem (columns).
using ChooseTerms = std::function<std::vector<Eigen::Index>(
    const fitting::SelectionProblem& problem)>;

/// Share of `repetitions` in which each candidate (m) is chosen when rows, or
/// whole parts of rows where `units` (r) has codes, are drawn with
/// replacement; drawn ones count as weights. Interrupted: NaN.
Eigen::VectorXd BootstrapInclusion(const DictionaryRows& rows,
                                   const std::vector<Eigen::Index>& units,
                                   int repetitions,
                                   const ChooseTerms& choose,
                                   const FitContext& context);

/// Puts the shares into the lines of `report`: its terms are `chosen`.
void ReportInclusion(const TermDictionary& dictionary,
                     const std::vector<Eigen::Index>& chosen,
                     const Eigen::VectorXd& shares,
                     RegressionReport* report);

}  // namespace errmap::models
