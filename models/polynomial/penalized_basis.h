#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "fitting/least_squares/penalized_path.h"
#include "models/error_model.h"
#include "models/history/view.h"
#include "models/inner_folds.h"
#include "models/polynomial/formula.h"
#include "models/polynomial/polynomial_design.h"
#include "models/polynomial/polynomial_options.h"
#include "models/polynomial/term_set.h"

namespace errmap::models {

/// Terms over rows in one view, for ridge and lasso. Products are of inputs
/// standardised over the training rows (mean 0, sd 1) unless `centring` says
/// otherwise, and the columns are standardised again in each fit.
struct PenalizedBasis {
  TermSet terms = TermSet::kLinear;
  int degree = 1;
  Centring centring = Centring::kStandardised;
  std::vector<NamedTerm> exclude;
  bool guarded = false;  // inputs and predictions clipped at the trained range
  /// How much squares of what differs between sessions weigh, of what changes
  /// within one: above 0, at most 1. Less than 1 is least squares where rows of
  /// a session share an offset of its own, by Fuller and Battese (1973): rows
  /// less 1 - sqrt(between) of their session's mean. Takes folds of whole
  /// sessions.
  double between = 1.0;
};

/// Held-out errors along the penalties of one family, and its fit to all rows
/// at the one chosen.
struct PenalizedCandidate {
  fitting::Penalty penalty = fitting::Penalty::kRidge;
  double strength = 0.0;
  double degrees_of_freedom = 0.0;
  // The inner hold-outs, falling strengths; empty where the strength was given.
  std::vector<double> strengths;
  std::vector<double> mean_squared_errors;  // TypicalError
  std::vector<double> standard_errors;      // of those means, over folds
  /// Root of the mean squared error of the chosen strength; NaN without inner
  /// hold-outs.
  double held_out_rmse = 0.0;
  /// (n) predictions of the rows held out, at the chosen strength; NaN for
  /// rows never held out; (0) where they were not kept.
  Eigen::VectorXd held_out;
  double intercept = 0.0;
  Eigen::VectorXd coefficients;  // (terms) in the scaled inputs of the design
};

/// A candidate and the basis that its coefficients belong to, without the rows:
/// those of all folds would be many.
struct PenalizedFit {
  std::vector<Eigen::Index> inputs;  // of the rows in their view
  ColumnScaling scaling;
  std::vector<TermPowers> terms;
  PenalizedCandidate candidate;

  /// `viewed` are the rows that were fitted; they must outlive the design.
  PolynomialDesign DesignOf(const ViewedRows& viewed) const {
    return {*viewed.rows, inputs, scaling, terms};
  }
};

/// Cross-products of a basis over each inner fold, from one pass over the rows:
/// all that its penalties need of them.
class SummedBasis;

/// `folds` are needed where the penalty is to be chosen by them; null where it
/// is given. Throws std::invalid_argument on too many terms or folds that are
/// missing; interrupted by context.stop with FitInterrupted's message.
std::shared_ptr<const SummedBasis> SumBasis(
    std::shared_ptr<const ViewedRows> viewed,
    const PenalizedBasis& basis,
    const InnerFolds* folds,
    const FitContext& context);

/// Fits a penalty to a basis. Held-out rows are clipped as the basis says, at
/// what their own fold trained on. Errors far below `indifference` (target's
/// unit) count alike. A ridge is searched on where the first three strengths
/// find an RMSE of at most `promising`. Throws std::invalid_argument where
/// folds are missing.
std::shared_ptr<const PenalizedFit> FitPenalty(
    const std::shared_ptr<const SummedBasis>& basis,
    fitting::Penalty penalty,
    const PenaltyRule& rule,
    double indifference,
    double promising);

/// The map of a candidate over the basis `design` of `viewed`, history and
/// guards attached. `raw` are the training rows before any view.
FittedModel MapOfCandidate(const std::string& name,
                           const data::Dataset& raw,
                           const ViewedRows& viewed,
                           const PolynomialDesign& design,
                           const PenalizedCandidate& candidate,
                           bool guarded);

}  // namespace errmap::models
