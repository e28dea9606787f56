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
/// with the chosen penalty.
struct PenalizedCandidate {
  fitting::Penalty penalty = fitting::Penalty::kRidge;
  double strength = 0.0;
  double degrees_of_freedom = 0.0;
  // From inner hold-outs, descending strengths; empty if it was given.
  std::vector<double> strengths;
  std::vector<double> mean_squared_errors;  // TypicalError
  std::vector<double> standard_errors;      // of those means, across folds
  /// Root of the mean squared error at the chosen strength; NaN without inner
  /// hold-outs.
  double held_out_rmse = 0.0;
  double intercept = 0.0;
  Eigen::VectorXd coefficients;  // (terms) for the scaled inputs of the design
};

/// A candidate and the basis of its coefficients, without the rows: those of
/// all folds would be too many.
struct PenalizedFit {
  std::vector<Eigen::Index> inputs;  // those of the viewed rows
  ColumnScaling scaling;
  std::vector<TermPowers> terms;
  PenalizedCandidate candidate;

  /// `viewed` are the fitted rows; they must outlive the design.
  PolynomialDesign DesignOf(const ViewedRows& viewed) const {
    return {*viewed.rows, inputs, scaling, terms};
  }
};

/// Fits a penalty to a basis. Held-out rows are clipped, if the basis says so,
/// to the ranges of their own fold's training rows. Errors far below
/// `indifference` (target's unit) count as equal. A ridge search ends early if
/// its first three strengths have an RMSE above `promising`. Throws
/// std::invalid_argument if folds are missing.
std::shared_ptr<const PenalizedFit> FitPenalty(const SummedBasis& basis,
                                               fitting::Penalty penalty,
                                               const PenaltyRule& rule,
                                               double indifference,
                                               double promising);

/// Returns the map of a candidate over the basis `design` of `viewed`, with
/// history and guards. `raw` are the training rows before any view.
FittedModel MapOfCandidate(const std::string& name,
                           const data::Dataset& raw,
                           const ViewedRows& viewed,
                           const PolynomialDesign& design,
                           const PenalizedCandidate& candidate,
                           bool guarded);

}  // namespace errmap::models
