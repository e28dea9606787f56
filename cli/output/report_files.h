#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/output/claimed_folder.h"
#include "cli/report/figures/figures.h"
#include "cli/study_setup/plan/study_plan.h"
#include "cli/study_setup/plan/study_run.h"
#include "models/study/record/study_record.h"

namespace errmap::cli {

/// Names of the two files that WriteReport writes.
inline constexpr const char* kReportPage = "report.html";
inline constexpr const char* kReportText = "report.md";

/// "learn-sessions": file names of `errmap learn --by sessions`, without
/// extension.
std::string LearningStem(std::string_view by);

/// Returns all figures of a study in its folder, including those that errmap
/// learn --out left there. A figure that cannot be read is named on stderr and
/// skipped.
report::FigureSet FiguresInFolder(const models::StudyRecord& record,
                                  const std::string& folder);

/// Writes report.html and report.md, each completely or not at all. `errmap
/// report` writes the same bytes from results.json. Throws std::system_error
/// that names the file.
void WriteReport(const models::StudyRecord& record, ClaimedFolder* folder);

/// Removes files that a killed run left half-written in a folder and its
/// models/.
void RemoveAbandoned(const std::string& folder);

/// Returns the names of all files that WriteOutputs may write for a study.
std::vector<std::string> OutputNames(const study_setup::StudyPlan& plan);

/// Writes the files of a run (study_setup::WriteRunFiles) and the report.
/// Throws std::system_error naming a path that cannot be written.
void WriteOutputs(const study_setup::StudyRun& run,
                  const models::StudyRecord& record,
                  ClaimedFolder* folder);

}  // namespace errmap::cli
