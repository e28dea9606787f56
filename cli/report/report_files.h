#pragma once

#include <string>

#include "models/study/study_record.h"

namespace errmap::cli {

/// Draws FOLDER/report.html and FOLDER/report.md; `errmap report` draws the
/// same bytes from results.json later. Each file appears whole or not at all.
/// Throws std::system_error naming what could not be written.
void WriteReport(const models::StudyRecord& record, const std::string& folder);

}  // namespace errmap::cli
