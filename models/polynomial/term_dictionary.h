#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fitting/selection/candidate_columns.h"
#include "fitting/selection/selection_state.h"
#include "fitting/selection/stepwise_selection.h"
#include "models/error_model.h"
#include "models/option_list.h"
#include "models/polynomial/formula.h"
#include "models/polynomial/polynomial_design.h"
#include "models/polynomial/polynomial_options.h"

namespace errmap::models {

/// What a SPEC may say of the terms that are chosen from: terms, degree,
/// centred, include and exclude.
OptionList<TermOptions> TermOptionList();
/// The degree and the terms left out, which penalised families have as well.
Option<std::optional<int>> DegreeOption();
Option<std::vector<NamedTerm>> TermsOption(const std::string& name,
                                           const std::string& about);

/// The terms that may be chosen over the inputs of a data set, and which of
/// them are forced in or out.
struct TermDictionary {
  TermDictionary(const data::Dataset& training, const TermOptions& options);

  int degree;
  PolynomialDesign design;
  std::vector<Eigen::Index> include;
  std::vector<bool> excluded;

  /// The terms with one power less of each, for heredity.
  std::vector<std::vector<Eigen::Index>> Parents() const;
  /// Candidates that may be chosen.
  Eigen::Index NumOpen() const;
};

/// Rows of a dictionary as the engines take them.
struct DictionaryRows {
  std::unique_ptr<fitting::CandidateColumns> candidates;
  Eigen::VectorXd response;
  Eigen::VectorXd weights;
  Eigen::VectorXd intercept;
  double observations = 0.0;
  std::vector<Eigen::Index> parts;  // see CollectRows

  bool are_observations() const { return intercept.size() == 0; }
  fitting::SelectionProblem Problem() const {
    return {*candidates, response, weights, intercept, observations};
  }
};

/// Throws std::invalid_argument where the dictionary is too large to be held
/// or reduced.
DictionaryRows CollectDictionary(const TermDictionary& dictionary,
                                 const std::vector<Eigen::Index>& parts,
                                 const FitContext& context);

/// Degree where none is given: 3 up to 8 inputs, else 2.
int DefaultDegree(Eigen::Index num_inputs);

/// What a fold chose is part of its result: "chosen: x, x*t".
std::string ChosenTerms(const TermDictionary& dictionary,
                        const std::vector<Eigen::Index>& chosen);

/// Why candidates that are not in a model add nothing to it, and what F the
/// others would have: into `report`; as far as it came where context.stop does.
void ReportExcluded(const TermDictionary& dictionary,
                    const DictionaryRows& rows,
                    const std::vector<Eigen::Index>& chosen,
                    double collinearity,
                    const FitContext& context,
                    RegressionReport* report);

}  // namespace errmap::models
