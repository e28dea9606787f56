#pragma once

#include <string>
#include <vector>

#include "fitting/least_squares/regression_diagnostics.h"
#include "fitting/selection/stepwise_selection.h"
#include "stats/not_a_number.h"

namespace errmap::models {

/// A term of a fitted polynomial with its line in the coefficient table, in the
/// inputs' own units.
struct ReportTerm {
  std::string name;
  fitting::CoefficientEstimate numbers;
  /// Share of the bootstrap repetitions that chose it; NaN if none were made.
  double inclusion = stats::kNaN;
};

struct ReportStep {
  std::string term;  // "" at the start
  fitting::SelectionStep numbers;
};

struct ExcludedReport {
  std::string name;
  double f = stats::kNaN;
  double p = stats::kNaN;
  double inclusion = stats::kNaN;
};

struct AliasReport {
  std::string name;
  std::string why;  // "is constant", "repeats t1_degC", "follows from ..."
};

/// Regression results of a fitted polynomial, for a statistician.
struct RegressionReport {
  std::string method;  // one line
  // How terms were chosen; empty if they were given.
  Eigen::Index candidates = 0;
  std::vector<ReportStep> steps;
  std::size_t chosen_step = 0;
  std::string ended;
  bool selected = false;         // p-values are after selection
  int bootstrap = 0;             // repetitions
  std::string bootstrap_unit;    // "cycle" or "row"
  std::string cross_validation;  // "groups:5 of cycle"; "" if there is none
  std::vector<ExcludedReport> excluded;  // falling F
  std::vector<AliasReport> aliased;
  // The fit itself.
  fitting::RegressionDiagnostics fit;
  fitting::RowDiagnostics rows;
  ReportTerm intercept;
  std::vector<ReportTerm> terms;
  /// The table's terms use each of these inputs minus this centre.
  std::vector<std::pair<std::string, double>> centres;
  bool weighted = false;
  // A penalised fit has estimates only; its table says so.
  bool penalised = false;
  double strength = 0.0;
  double degrees_of_freedom = 0.0;
  std::vector<double> strengths;
  std::vector<double> mean_squared_errors;
  std::vector<double> standard_errors;
  std::vector<std::string> notes;  // one line each
};

}  // namespace errmap::models
