#pragma once

#include <string>
#include <vector>

#include "cli/report/number_text.h"
#include "cli/report/report_view.h"
#include "cli/report/table.h"

namespace errmap::report {

/// Errors among neighbours compared with those on unseen groups.
Table GapTable(const ReportView& view);

/// The recommended model compared with every other one: differences and tests.
Table ComparisonTable(const ReportView& view, const std::string& holdout);

/// How often each model wins over repeated splits of the groups.
Table StabilityTable(const ReportView& view);

/// The recommended map's error by time since the session's start.
Table SinceStartTable(const ReportView& view);

/// Residual statistics of every model, as in the report's section 9.
Table ResidualTable(const ReportView& view, const std::string& holdout);
/// Tests of normality of every model's held-out residuals.
Table NormalityTable(const ReportView& view, const std::string& holdout);
/// Tests of independence and bias of every model's held-out residuals.
Table IndependenceTable(const ReportView& view, const std::string& holdout);

// The results of models, for people and for files. Columns are declared once,
// in result_table.cc, with their names and the tables that have them.

/// p with Holm's correction, and `after`; nothing if the units are too few for
/// any difference to show.
Cell CorrectedP(const models::PairRecord& pair, const char* after = "");

/// One row for each component, hold-out and model.
Table LeaderboardRows(const models::StudyRecord& record);

/// For terminals, sorted by the decisive error: sensors, that error with its
/// interval, the error among neighbours, the goal. At most `most_rows`,
/// including the recommended one: "*" before its name, "=" before those as good
/// as the best.
Table TerminalLeaderboard(const ReportView& view, std::size_t most_rows);

/// Details for one hold-out: training error, tier, p, and whether the
/// difference from the recommended model is established.
Table TerminalDetails(const ReportView& view, const std::string& holdout);
/// Parameters, gap and times.
Table TerminalTimes(const ReportView& view);

/// One row for each component: the map to use, its error and how sure it is.
Table SummaryRows(const models::StudyRecord& record);
inline constexpr std::size_t kIntervalColumn = 3;
inline constexpr std::size_t kProvenColumn = 4;

/// Returns a sentence on the models fitted to only part of the rows, and how to
/// use all; "" if there are none.
std::string DrawnRowsWords(const ReportView& view);

/// Returns a sentence on the input of poly:temperature if the data have no
/// thermometer and it is among the first `most_rows` models; else "".
std::string StandInWords(const ReportView& view, std::size_t most_rows);

/// One row for each model, with the hold-outs, the decisive one first: errors,
/// significance, goal, cost.
Table PageLeaderboard(const ReportView& view);

// Further tables.

/// The error of each map and the cost of a step on a controller.
Table CostTable(const ReportView& view);

/// The fits to all rows: each optimiser's work, how it stopped, and its time
/// per iteration (the report's Table 4).
Table RunTable(const ReportView& view);

/// Every fit of every fold: errors, iterations, termination.
Table FoldTable(const ReportView& view);

/// Every start of nets with several starts.
Table StartTable(const ReportView& view);

/// Nets fitted to shuffled targets, to show whether they learn noise.
Table ShuffledTargetTable(const ReportView& view);

/// Options and choices of every model.
Table OptionTable(const ReportView& view);

/// Columns left out of the inputs, with the reasons.
Table DroppedTable(const ReportView& view);

/// How rows were held out.
Table HoldoutTable(const ReportView& view);

/// The origin of the results, for the whole document.
Table ProvenanceTable(const models::StudyRecord& record);

/// The steps of a selection; no rows if the terms were given.
Table StepTable(const models::RegressionRecord& regression);

/// The coefficients with available statistics.
Table CoefficientTable(const models::RegressionRecord& regression);

/// The analysis of variance; no rows for a penalised fit.
Table AnovaTable(const models::RegressionRecord& regression);

/// The terms that were left out, those of largest F first.
Table ExcludedTerms(const models::RegressionRecord& regression);

/// The terms that others determine.
Table AliasedTerms(const models::RegressionRecord& regression);

/// s, R2, PRESS, largest residual, condition and rank, or the corresponding
/// figures of a penalised fit. "" if nothing was kept.
std::string RegressionSummary(const models::RegressionRecord& regression,
                              const ErrorText& error);

/// The models with an equation or a regression, the recommended one first;
/// baselines are left out.
std::vector<const ModelRecord*> PolynomialsOf(const ReportView& view);

}  // namespace errmap::report
