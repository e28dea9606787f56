#pragma once

#include "cli/report/report_view.h"
#include "cli/report/table.h"

namespace errmap::report {

// What models achieved, for people and for files. The columns are declared
// once, in the .cc file, with what each is called and where it stands.

/// A row per component, hold-out and model.
Table LeaderboardRows(const models::StudyRecord& record);

/// For terminals, by the decisive error: sensors, that error with its interval,
/// the error between neighbours, the goal. At most `most_rows`, the recommended
/// one among them: "*" before its name, "=" before those as good as the best.
Table TerminalLeaderboard(const ReportView& view, std::size_t most_rows);

/// What stands behind it: training error, tier, p and whether the difference
/// from the recommended one is established, under one hold-out.
Table TerminalDetails(const ReportView& view, const std::string& holdout);
/// Parameters, gap and times.
Table TerminalTimes(const ReportView& view);

/// A row per component: what to use, and how good and how sure that is.
Table SummaryRows(const models::StudyRecord& record);
inline constexpr std::size_t kIntervalColumn = 3;
inline constexpr std::size_t kProvenColumn = 4;

/// "unseen cycle", "another file", "held-out rows": what decides.
std::string UnseenWords(const ReportView& view);

/// Which models learnt from a part of the rows, and how to have all; "" where
/// none did.
std::string DrawnRowsWords(const ReportView& view);

/// A row per model under the hold-outs, the decisive one first: errors,
/// significance, goal, cost.
Table PageLeaderboard(const ReportView& view);

}  // namespace errmap::report
