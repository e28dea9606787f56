#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "models/record.h"

// The regression results of a fitted polynomial, for a statistician, as they
// are in results.json: selection steps, coefficients and their statistics.

namespace errmap::models {

/// fitting::SelectionStep
struct StepRecord {
  std::optional<std::string> term;  // empty at the start
  bool entered = false;
  std::int64_t terms = 0;
  double f = kNotKnown;
  double p = kNotKnown;
  double rss = kNotKnown;
  double aic = kNotKnown;
  double aicc = kNotKnown;
  double bic = kNotKnown;
  double adjusted_r2 = kNotKnown;
  double press = kNotKnown;
  double cp = kNotKnown;
  double cv = kNotKnown;
};

/// Statistics that the intercept lacks.
struct TermRecord {
  double standardised = kNotKnown;
  double vif = kNotKnown;
  double bootstrap_inclusion = kNotKnown;  // 0 to 1
};

/// A line of the coefficient table, in the inputs' own units;
/// fitting::CoefficientEstimate.
struct CoefficientRecord {
  std::string term;
  double estimate = kNotKnown;
  double standard_error = kNotKnown;
  double t = kNotKnown;
  double p = kNotKnown;
  IntervalRecord ci95 = {kNotKnown, kNotKnown};
  Inline<std::optional<TermRecord>> of_term;
};

struct ExcludedRecord {
  std::string term;
  double f = kNotKnown;
  double p = kNotKnown;
  double bootstrap_inclusion = kNotKnown;
};

struct AliasedRecord {
  std::string term;
  std::string why;  // "is constant", "repeats t1_degC", "follows from ..."
};

struct PenaltyChoiceRecord {
  std::string holdout;  // "groups:5 of cycle"; "" if there is none
  std::vector<double> penalty;
  std::vector<double> mse;
  std::vector<double> standard_error;
};

/// For a penalised fit.
struct PenaltyRecord {
  double penalty = kNotKnown;
  double effective_parameters = kNotKnown;
  PenaltyChoiceRecord cross_validation;
};

struct AnovaRecord {
  std::int64_t regression_df = 0;
  double regression_ss = kNotKnown;
  double residual_df = kNotKnown;
  double residual_ss = kNotKnown;
  double total_ss = kNotKnown;
  double f = kNotKnown;
  double p = kNotKnown;
};

struct BootstrapRecord {
  std::int64_t repetitions = 0;
  std::string unit;  // "cycle" or "row"
};

/// For a least-squares fit: fitting::RegressionDiagnostics, RowDiagnostics.
struct LeastSquaresRecord {
  AnovaRecord anova;
  double s = kNotKnown;
  double r2 = kNotKnown;
  double adjusted_r2 = kNotKnown;
  double press = kNotKnown;
  double predicted_r2 = kNotKnown;
  std::int64_t rows_of_leverage_1 = 0;
  double largest_residual = kNotKnown;
  std::int64_t largest_residual_row = 0;
  double largest_leverage = kNotKnown;
  double condition = kNotKnown;
  std::int64_t effective_rank = 0;
  std::int64_t bits = 0;                 // of the arithmetic of the estimates
  std::vector<ExcludedRecord> excluded;  // falling F
  std::vector<AliasedRecord> aliased;
  bool after_selection = false;  // p-values are
  BootstrapRecord bootstrap;
  std::vector<std::string> notes;  // one line each
};

struct RegressionRecord {
  std::string method;  // one line
  // How terms were chosen; empty if they were given.
  std::int64_t candidates = 0;
  std::vector<StepRecord> steps;
  std::int64_t chosen_step = 0;
  std::string ended;
  /// The intercept is first, if there is one.
  std::vector<CoefficientRecord> coefficients;
  /// The terms in the table use these inputs minus their centres.
  ByName<double> centres;
  Inline<std::optional<PenaltyRecord>> penalised;
  Inline<std::optional<LeastSquaresRecord>> least_squares;
};

}  // namespace errmap::models
