#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fitting/selection/candidate_columns.h"
#include "fitting/selection/selection_state.h"
#include "fitting/selection/stepwise_selection.h"
#include "models/error_model.h"
#include "models/model_spec.h"
#include "models/polynomial/formula.h"
#include "models/polynomial/polynomial_design.h"
#include "models/polynomial/term_set.h"

namespace errmap::models {

/// The options that all recipes share which choose among terms.
struct TermOptions {
  TermSet set = TermSet::kFull;
  int degree = 0;  // 1 .. 4; 0: DefaultDegreeOf the set
  Centring centring = Centring::kAll;
  std::vector<NamedTerm> include;
  std::vector<NamedTerm> exclude;

  /// Takes terms, degree, centred and exclude, and include where it is allowed.
  static TermOptions Take(SpecOptions* options, bool with_include);
  /// Those that are not the default.
  void Describe(std::vector<EffectiveOption>* options) const;
};

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

/// Why candidates that are not in a model add nothing to it, and what F the
/// others would have: into `report`; as far as it came where context.stop does.
void ReportExcluded(const TermDictionary& dictionary,
                    const DictionaryRows& rows,
                    const std::vector<Eigen::Index>& chosen,
                    double collinearity,
                    const FitContext& context,
                    RegressionReport* report);

}  // namespace errmap::models
