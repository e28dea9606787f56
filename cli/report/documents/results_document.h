#pragma once

#include "cli/study_file/comparison.h"
#include "models/study/record/study_record.h"

namespace errmap::cli {

/// What a run found, judged and put into words: results.json, and what every
/// table and page is drawn from.
models::StudyRecord RecordOf(const StudyRun& run);

}  // namespace errmap::cli
