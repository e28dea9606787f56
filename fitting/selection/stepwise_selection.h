#pragma once

#include <atomic>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "fitting/fold_codes.h"
#include "fitting/information_criteria.h"
#include "fitting/selection/selection_state.h"

namespace errmap::fitting {

enum class Direction { kForward, kBackward, kBoth };
enum class Heredity { kNone, kWeak, kStrong };

struct StepwiseOptions {
  Direction direction = Direction::kForward;
  /// What the best move is judged by. AIC, AICc, BIC, adjusted R2, Cp and p
  /// agree on the best entry and on the best exit; PRESS and CV do not.
  Criterion select = Criterion::kBic;
  /// The moves end where the best does not lower this (p: where it is not
  /// significant); kNone: when no move is left.
  Criterion stop = Criterion::kBic;
  /// The lowest of the models passed through is taken (p and kNone: the last).
  Criterion choose = Criterion::kBic;
  /// p: a term enters with p <= enter and leaves with p > remove;
  /// 0 < enter <= remove < 1, since a term could enter and leave for ever
  /// otherwise.
  double enter = 0.05;
  double remove = 0.10;
  Heredity heredity = Heredity::kNone;
  /// Most terms; below 0: no limit but the rows.
  Eigen::Index max_terms = -1;
  /// A candidate is passed over while what the chosen terms leave of it is
  /// shorter than this times the candidate; above 0, below 1. R's lm has 1e-7.
  double collinearity = 1e-7;
  /// Error variance for Cp; NaN: that of the model of all candidates.
  double sigma2 = std::numeric_limits<double>::quiet_NaN();

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
  /// True where `criterion` selects, stops or chooses.
  bool Uses(Criterion criterion) const;
};

/// What may enter and leave.
struct TermRules {
  std::vector<Eigen::Index> include;  // always in, in this order
  std::vector<bool> excluded;         // (m) never in; empty: none
  /// (m) the terms with one power less, as columns; -1 for one that is no
  /// candidate. Empty: no heredity.
  std::vector<std::vector<Eigen::Index>> parents;
  FoldCodes folds;  // for CV; without codes: none
};

/// One step of a selection; NaN: not computed or not defined.
struct SelectionStep {
  Eigen::Index candidate = -1;           // -1: the start
  double residual_sum_of_squares = 0.0;  // weighted
  double bic = 0.0;
  bool entered = true;
  Eigen::Index terms = 0;  // after the step, without the intercept
  /// Partial F of the term that came or went (1 and n - k degrees of freedom,
  /// k coefficients of the larger model) and its p.
  double f = std::numeric_limits<double>::quiet_NaN();
  double p = std::numeric_limits<double>::quiet_NaN();
  double aic = std::numeric_limits<double>::quiet_NaN();
  double aicc = std::numeric_limits<double>::quiet_NaN();
  double adjusted_r2 = std::numeric_limits<double>::quiet_NaN();
  /// Sum of w (e / (1 - h))^2, infinite where a leverage is 1; NaN where rows
  /// are no observations.
  double press = std::numeric_limits<double>::quiet_NaN();
  double cp = std::numeric_limits<double>::quiet_NaN();
  /// Squared error on held-out folds, the terms taken as given.
  double cv = std::numeric_limits<double>::quiet_NaN();

  /// Value of a criterion, the lower the better (adjusted R2 is negated).
  double ValueOf(Criterion criterion) const;
};

struct SelectionResult {
  std::vector<Eigen::Index> chosen;  // columns of the design, in order of entry
  std::vector<SelectionStep> steps;  // the start and each move
  std::size_t chosen_step = 0;       // the step whose model was chosen
  std::vector<Eigen::Index> aliased_includes;  // determined by those before
  std::string ended;           // why the moves ended, for people
  bool at_most_terms = false;  // ... which is StepwiseOptions::max_terms
};

/// Stepwise selection. From the intercept and `rules.include` (backward: from
/// all candidates), makes the best move for as long as `options.stop` allows,
/// and returns the model that `options.choose` prefers. At least one degree of
/// freedom is left to the residual. Ties go to the lowest column.
///
/// `stop_token` ends the moves early where it becomes true (null: never).
/// Throws std::invalid_argument on bad shapes or options, on PRESS where rows
/// are no observations, on CV without folds, on Cp without a variance, and on
/// backward selection with more candidates than rows.
SelectionResult SelectStepwise(const SelectionProblem& problem,
                               const TermRules& rules,
                               const StepwiseOptions& options,
                               const std::atomic<bool>* stop_token = nullptr);

/// A candidate outside a model.
struct ExcludedTerm {
  Eigen::Index candidate = -1;
  bool aliased = false;  // the model's terms determine it
  double f = std::numeric_limits<double>::quiet_NaN();  // if it came in now
  double p = std::numeric_limits<double>::quiet_NaN();
};

/// Every candidate that is not in `chosen`, with the partial F that it would
/// have if it entered now; in the order of the columns. Those judged so far
/// where `stop_token` becomes true (null: never).
std::vector<ExcludedTerm> JudgeExcluded(
    const SelectionProblem& problem,
    const std::vector<Eigen::Index>& chosen,
    double collinearity,
    const std::atomic<bool>* stop_token = nullptr);

/// Squared error of the terms in `design` (n x k, intercept and weights
/// included) on each judged fold when fitted to the rows that predict it.
double CrossValidatedError(const Eigen::MatrixXd& design,
                           const Eigen::VectorXd& response,
                           const FoldCodes& folds);

struct ForwardSelectionOptions {
  /// Most candidates to choose; below 0: no limit but the rows.
  Eigen::Index max_terms = -1;
  /// See StepwiseOptions.
  double collinearity = 1e-7;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// SelectStepwise forward by BIC (Schwarz 1978) on a matrix.
///
/// `candidates` (n x m) without an intercept column, `response` (n), `weights`
/// (n) not negative or (0).
SelectionResult SelectForward(const Eigen::MatrixXd& candidates,
                              const Eigen::VectorXd& response,
                              const Eigen::VectorXd& weights,
                              const ForwardSelectionOptions& options = {});

}  // namespace errmap::fitting
