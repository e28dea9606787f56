#pragma once

#include <string>
#include <vector>

#include "cli/report/report_view.h"
#include "cli/report/table.h"

namespace errmap::report {

/// Error beside what a step of each map costs on a controller.
Table CostTable(const ReportView& view);

/// The fits to all rows: what each optimiser did, how it stopped, time per
/// iteration (the report's Table 4).
Table RunTable(const ReportView& view);

/// Every fit of every fold: errors, iterations, stop.
Table FoldTable(const ReportView& view);

/// Every start of the nets with several.
Table StartTable(const ReportView& view);

/// Nets fitted to shuffled targets: can they learn noise?
Table MemorisationTable(const ReportView& view);

/// What is told of one polynomial.
struct PolynomialTables {
  std::string model;
  std::string equation;
  std::string method;
  std::string summary;  // s, R2, PRESS, condition
  Table coefficients;
  Table excluded;
  Table aliased;
};
/// Of every model with an equation or a regression, the recommended one first.
std::vector<PolynomialTables> PolynomialTablesOf(const ReportView& view);

/// Options and choices of every model.
Table OptionTable(const ReportView& view);

/// Columns left out of the inputs, and why.
Table DroppedTable(const ReportView& view);

/// How rows were held out.
Table HoldoutTable(const ReportView& view);

/// Where the figures come from: of the whole document.
Table ProvenanceTable(const models::StudyRecord& record);

}  // namespace errmap::report
