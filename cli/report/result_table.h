#pragma once

#include "cli/report/report_view.h"
#include "cli/report/table.h"

namespace errmap::cli {

// What models achieved, for people and for files. The columns are declared
// once, in the .cc file, with what each is called and where it stands.

/// A row per component, hold-out and model.
Table LeaderboardRows(const models::StudyRecord& record);

/// A row per model, the hold-outs side by side.
Table TerminalLeaderboard(const models::ComponentRecord& component);

/// A row per model under the hold-outs, the decisive one first: tier, errors,
/// significance, goal, cost.
Table PageLeaderboard(const ReportView& view);

}  // namespace errmap::cli
