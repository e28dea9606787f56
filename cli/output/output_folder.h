#pragma once

#include <string>
#include <vector>

#include "cli/desk/plan/study_plan.h"
#include "cli/desk/plan/study_run.h"
#include "cli/output/claimed_folder.h"
#include "models/study/record/study_record.h"

namespace errmap::cli {

/// Removes what a killed run left half-written in a folder and its models/.
void RemoveAbandoned(const std::string& folder);

/// Returns the names of all files that WriteOutputs may write for a study.
std::vector<std::string> OutputNames(const desk::StudyPlan& plan);

/// Writes the files of a run (desk::WriteRunFiles) and the report. Throws
/// std::system_error naming a path that cannot be written.
void WriteOutputs(const desk::StudyRun& run,
                  const models::StudyRecord& record,
                  ClaimedFolder* folder);

}  // namespace errmap::cli
