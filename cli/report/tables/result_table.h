#pragma once

#include "cli/report/report_view.h"
#include "cli/report/table.h"

namespace errmap::report {

// The results of models, for people and for files. Columns are declared once,
// in the .cc file, with their names and the tables that have them.

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

/// "unseen cycle", "another file", "neighbours": what a hold-out holds out.
std::string UnseenWords(const ReportView& view, const std::string& holdout);

/// Says which models learnt from a part of the rows, and how to use all; "" if
/// none did.
std::string DrawnRowsWords(const ReportView& view);

/// Says what poly:temperature reads where the data have no thermometer; "" if
/// they have one.
std::string StandInWords(const ReportView& view);

/// One row for each model, with the hold-outs, the decisive one first: errors,
/// significance, goal, cost.
Table PageLeaderboard(const ReportView& view);

}  // namespace errmap::report
