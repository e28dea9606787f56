#pragma once

#include "cli/study_file/comparison.h"
#include "models/study/record/study_record.h"

namespace errmap::cli {

/// What a run found, judged and put into words: results.json, and what every
/// table and page is drawn from. `jobs`: threads that may assess residuals.
models::StudyRecord RecordOf(const StudyRun& run, int jobs = 1);

}  // namespace errmap::cli
