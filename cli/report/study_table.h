#pragma once

#include <string>

#include "cli/study_file/comparison.h"
#include "models/study/study_record.h"

namespace errmap::cli {

/// The run, of which `record` is, as text for a terminal: of each component
/// what was compared, one row per model with the hold-outs side by side, and
/// the verdict in words.
std::string StudyTable(const StudyRun& run, const models::StudyRecord& record);

}  // namespace errmap::cli
