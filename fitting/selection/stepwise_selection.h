#pragma once

#include <string>
#include <vector>

#include "fitting/fold_codes.h"
#include "fitting/information_criteria.h"
#include "fitting/selection/selection_state.h"
#include "stats/eigen.h"
#include "stats/not_a_number.h"

namespace errmap::fitting {

enum class Direction { kForward, kBackward, kBoth };
enum class Heredity { kNone, kWeak, kStrong };

struct StepwiseOptions {
  Direction direction = Direction::kForward;
  /// Criterion for the best move. AIC, AICc, BIC, adjusted R2, Cp and p agree
  /// on the best entry and on the best exit; PRESS and CV may not.
  Criterion select = Criterion::kBic;
  /// Stops when the best move does not lower this (p: is not significant);
  /// kNone: when no move is left.
  Criterion stop = Criterion::kBic;
  /// Chooses the model of lowest value among all steps (p and kNone: the last).
  Criterion choose = Criterion::kBic;
  /// p: a term enters if p <= enter and leaves if p > remove. 0 <
  /// enter <= remove < 1; otherwise a term could enter and leave
  /// forever.
  double enter = 0.05;
  double remove = 0.10;
  Heredity heredity = Heredity::kNone;
  /// Maximum number of terms; below 0: limited only by the rows.
  Index max_terms = -1;
  /// Error variance for Cp; NaN: that of the model with all candidates.
  double sigma2 = stats::kNaN;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
  /// Returns true if `criterion` selects, stops or chooses.
  bool Uses(Criterion criterion) const;
};

/// Rules for entering and leaving.
struct TermRules {
  std::vector<Index> include;  // always in, in this order
  std::vector<bool> excluded;  // (m) never in; empty: none
  /// (m) columns of the terms with one power less; -1 for one that is not a
  /// candidate. Empty: no heredity.
  std::vector<std::vector<Index>> parents;
  FoldCodes folds;  // for CV; without codes: none
};

/// One step of a selection; NaN if not computed or not defined.
struct SelectionStep {
  Index candidate = -1;                  // -1: the start
  double residual_sum_of_squares = 0.0;  // weighted
  double bic = 0.0;
  bool entered = true;
  Index terms = 0;  // after the step, without the intercept
  /// Partial F of the term that entered or left (1 and n - k degrees of
  /// freedom, k coefficients of the larger model) and its p.
  double f = stats::kNaN;
  double p = stats::kNaN;
  double aic = stats::kNaN;
  double aicc = stats::kNaN;
  double adjusted_r2 = stats::kNaN;
  /// Sum of w (e / (1 - h))^2, infinite if a leverage is 1. NaN if the rows are
  /// not observations.
  double press = stats::kNaN;
  double cp = stats::kNaN;
  /// Squared error on held-out folds, for the terms as given.
  double cv = stats::kNaN;

  /// Returns a criterion's value; lower is better (adjusted R2 is negated).
  double ValueOf(Criterion criterion) const;
};

struct SelectionResult {
  std::vector<Index> chosen;         // columns of the design, in order of entry
  std::vector<SelectionStep> steps;  // the start and each move
  std::size_t chosen_step = 0;       // the step whose model was chosen
  std::vector<Index> aliased_includes;  // determined by earlier ones
  std::string ended;                    // why the selection ended, as text
  bool at_most_terms = false;           // ... because of max_terms
};

/// Stepwise selection. Starts from the intercept and `rules.include` (backward:
/// from all candidates), makes the best move while `options.stop` allows it,
/// and returns the model that `options.choose` prefers. Keeps at least one
/// residual degree of freedom. Ties go to the lowest column. Ends early if
/// interrupted.
///
/// Throws std::invalid_argument for bad shapes or options, such as CV without
/// folds or Cp without a variance. Also for PRESS on rows that are not
/// observations, and backward selection with more candidates than rows.
SelectionResult SelectStepwise(const RegressionProblem& problem,
                               const TermRules& rules,
                               const StepwiseOptions& options);

/// A candidate outside a model.
struct ExcludedTerm {
  Index candidate = -1;
  bool aliased = false;    // the model's terms determine it
  double f = stats::kNaN;  // if it entered now
  double p = stats::kNaN;
};

/// Returns every candidate that is not in `chosen`, in column order, with its
/// partial F if it entered now. If interrupted, returns those tested so far.
std::vector<ExcludedTerm> JudgeExcluded(const RegressionProblem& problem,
                                        const std::vector<Index>& chosen);

/// Returns the sum of squared errors over the tested folds (FoldCodes). Each is
/// predicted by the terms in `design` (n x k, with intercept and weights).
double CrossValidatedError(const MatrixXd& design,
                           const VectorXd& response,
                           const FoldCodes& folds);

}  // namespace errmap::fitting
