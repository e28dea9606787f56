#pragma once

#include <string>
#include <string_view>

#include "cli/output/claimed_folder.h"
#include "cli/report/figures/figures.h"
#include "models/study/record/study_record.h"

namespace errmap::cli {

/// Names of the two files that WriteReport draws.
inline constexpr const char* kReportPage = "report.html";
inline constexpr const char* kReportText = "report.md";

/// "learn-sessions": the files of `errmap learn --by sessions` less their ends.
std::string LearningStem(std::string_view by);

/// All figures of a study in its folder, those of what errmap learn --out left
/// there among them; a file of it that cannot be read is named on stderr and
/// passed over.
report::FigureSet FiguresInFolder(const models::StudyRecord& record,
                                  const std::string& folder);

/// Draws report.html and report.md; `errmap report` draws the same bytes from
/// results.json later. Each file appears whole or not at all. Throws
/// std::system_error naming what could not be written.
void WriteReport(const models::StudyRecord& record, ClaimedFolder* folder);

}  // namespace errmap::cli
