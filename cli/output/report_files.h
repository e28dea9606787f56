#pragma once

#include <string>
#include <vector>

#include "cli/output/claimed_folder.h"
#include "models/promise/learning_record.h"
#include "models/report/figures/figures.h"
#include "models/study/record/study_record.h"

namespace errmap::cli {

/// Names of the two files that WriteReport draws.
inline constexpr const char* kReportPage = "report.html";
inline constexpr const char* kReportText = "report.md";

/// What errmap learn --out left in the folder of a study. A file that cannot be
/// read is named on stderr and passed over.
std::vector<models::LearningRecord> ReadLearning(const std::string& folder);

/// All figures of a study in its folder, those of ReadLearning among them.
report::FigureSet FiguresInFolder(const models::StudyRecord& record,
                                  const std::string& folder,
                                  bool everything = false);

/// Draws report.html and report.md; `errmap report` draws the same bytes from
/// results.json later. Each file appears whole or not at all. Throws
/// std::system_error naming what could not be written.
void WriteReport(const models::StudyRecord& record, ClaimedFolder* folder);

}  // namespace errmap::cli
