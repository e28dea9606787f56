#pragma once

#include "models/study/record/study_record.h"
#include "models/study_file/plan/study_run.h"

namespace errmap::study_file {

/// What a run found, judged and put into words: results.json, and what every
/// table and page is drawn from. `jobs`: threads that may assess residuals.
models::StudyRecord RecordOf(const StudyRun& run, int jobs = 1);

}  // namespace errmap::study_file
