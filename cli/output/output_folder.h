#pragma once

#include <string>
#include <vector>

#include "cli/desk/plan/study_plan.h"
#include "cli/desk/plan/study_run.h"
#include "cli/output/claimed_folder.h"
#include "models/study/record/study_record.h"

namespace errmap::cli {

/// Removes what a killed run had begun to write into a folder and its models/.
void RemoveAbandoned(const std::string& folder);

/// Names of all files that WriteOutputs may write of a study.
std::vector<std::string> OutputNames(const desk::StudyPlan& plan);

/// Writes the files of a run (desk::WriteRunFiles) and the report.
/// Throws std::system_error naming the path that could not be written.
void WriteOutputs(const desk::StudyRun& run,
                  const models::StudyRecord& record,
                  ClaimedFolder* folder);

}  // namespace errmap::cli
