#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "fitting/least_squares/penalized_path.h"
#include "models/error_model.h"
#include "models/history/view.h"
#include "models/polynomial/penalized_basis.h"
#include "models/polynomial/polynomial_design.h"
#include "models/polynomial/polynomial_options.h"

namespace errmap::models {

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

/// Fits a penalty to a basis. Held-out rows are clipped as the basis says, at
/// what their own fold trained on. Errors far below `indifference` (target's
/// unit) count alike. A ridge is searched on where the first three strengths
/// find an RMSE of at most `promising`. Throws std::invalid_argument where
/// folds are missing.
std::shared_ptr<const PenalizedFit> FitPenalty(const SummedBasis& basis,
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
