#pragma once

#include <string>
#include <vector>

#include "cli/output/claimed_folder.h"
#include "cli/study_file/comparison.h"
#include "cli/study_file/plan/study_plan.h"
#include "models/study/record/study_record.h"

namespace errmap::cli {

/// Removes what a killed run had begun to write into a folder and its models/.
void RemoveAbandoned(const std::string& folder);

/// Names of all files that WriteOutputs may write of a study.
std::vector<std::string> OutputNames(const StudyPlan& plan);

/// Says of each map in `record` which file WriteOutputs makes of it.
void NameMaps(const StudyRun& run, models::StudyRecord* record);

/// Writes results.json (`record`), residuals.csv, models/*.json and the
/// report into a folder; of several components residuals/COMPONENT.csv and
/// models/COMPONENT/*.json.
/// Throws std::system_error naming the path that could not be written.
void WriteOutputs(const StudyRun& run,
                  const models::StudyRecord& record,
                  ClaimedFolder* folder);

}  // namespace errmap::cli
