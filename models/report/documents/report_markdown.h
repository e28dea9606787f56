#pragma once

#include <string>

#include "models/study/record/study_record.h"

namespace errmap::report {

/// report.md: the answer, the tables and the equations of results.json, for
/// repositories; no figures.
std::string ReportMarkdown(const models::StudyRecord& record);

}  // namespace errmap::report
