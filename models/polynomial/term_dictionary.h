#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fitting/selection/selection_state.h"
#include "fitting/selection/stepwise_selection.h"
#include "models/error_model.h"
#include "models/option_list.h"
#include "models/polynomial/formula.h"
#include "models/polynomial/polynomial_design.h"
#include "models/polynomial/polynomial_options.h"

namespace errmap::models {

/// Options in a SPEC of the terms to choose from: terms, degree, centred,
/// include and exclude.
OptionList<TermOptions> TermOptionList();
/// Adds the options degree and exclude, which penalised families also have.
Option<std::optional<int>> DegreeOption();
Option<std::vector<NamedTerm>> TermsOption(const std::string& name,
                                           const std::string& about);

/// The terms that may be chosen over the inputs of a data set, and those that
/// are forced in or out.
struct TermDictionary {
  TermDictionary(const data::Dataset& training, const TermOptions& options);

  int degree;
  PolynomialDesign design;
  std::vector<Index> include;
  std::vector<bool> excluded;

  /// Returns, for heredity, the terms with one power less of each.
  std::vector<std::vector<Index>> Parents() const;
  /// Returns the candidates that may be chosen.
  Index NumOpen() const;
};

struct LeastSquaresRecord;

/// Returns the choice in a fold, as part of its result: "chosen: x, x*t".
std::string ChosenTerms(const TermDictionary& dictionary,
                        const std::vector<Index>& chosen);

/// Adds to `record`, for each candidate outside a model, its F or why it adds
/// nothing. Stops early if interrupted.
void ReportExcluded(const TermDictionary& dictionary,
                    const DesignRows& rows,
                    const std::vector<Index>& chosen,
                    LeastSquaresRecord* record);

}  // namespace errmap::models
