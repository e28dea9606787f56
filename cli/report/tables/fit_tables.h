#pragma once

#include "cli/report/report_view.h"
#include "cli/report/table.h"

namespace errmap::report {

/// The error of each map and the cost of a step on a controller.
Table CostTable(const ReportView& view);

/// The fits to all rows: each optimiser's work, how it stopped, and its time
/// per iteration (the report's Table 4).
Table RunTable(const ReportView& view);

/// Every fit of every fold: errors, iterations, termination.
Table FoldTable(const ReportView& view);

/// Every start of nets with several starts.
Table StartTable(const ReportView& view);

/// Nets fitted to shuffled targets: can they learn noise?
Table MemorisationTable(const ReportView& view);

/// Options and choices of every model.
Table OptionTable(const ReportView& view);

/// Columns left out of the inputs, with the reasons.
Table DroppedTable(const ReportView& view);

/// How rows were held out.
Table HoldoutTable(const ReportView& view);

/// The origin of the results, for the whole document.
Table ProvenanceTable(const models::StudyRecord& record);

}  // namespace errmap::report
