#pragma once

#include "cli/desk/plan/study_run.h"
#include "models/study/record/study_record.h"

namespace errmap::desk {

/// What a run found, judged and put into words: results.json, and what every
/// table and page is drawn from. `jobs`: threads that may assess residuals.
models::StudyRecord RecordOf(const StudyRun& run, int jobs = 1);

}  // namespace errmap::desk
