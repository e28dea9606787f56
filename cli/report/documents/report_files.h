#pragma once

#include "cli/report/claimed_folder.h"
#include "models/study/record/study_record.h"

namespace errmap::cli {

/// Names of the two files that WriteReport draws.
inline constexpr const char* kReportPage = "report.html";
inline constexpr const char* kReportText = "report.md";

/// Draws report.html and report.md; `errmap report` draws the same bytes from
/// results.json later. Each file appears whole or not at all. Throws
/// std::system_error naming what could not be written.
void WriteReport(const models::StudyRecord& record, ClaimedFolder* folder);

}  // namespace errmap::cli
