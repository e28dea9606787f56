#pragma once

#include <string>

#include "cli/study_file/comparison.h"

namespace errmap::cli {

/// Every figure as a table: one row per component, hold-out and model, in the
/// data's unit (its column is last). Figures of a model that failed are empty.
std::string LeaderboardCsv(const StudyRun& run);

/// The same rows as a Markdown table, with fewer digits; lengths in um.
std::string LeaderboardMarkdown(const StudyRun& run);

}  // namespace errmap::cli
