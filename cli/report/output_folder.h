#pragma once

#include <string>

#include "cli/study_file/comparison.h"
#include "models/study/study_record.h"

namespace errmap::cli {

/// Creates the folder `path` (and its parents) where it is missing and makes
/// sure that files can be written there. Throws std::system_error.
void PrepareFolder(const std::string& path);

/// Removes what a killed run had begun to write into a folder and its models/.
void RemoveAbandoned(const std::string& folder);

/// Writes results.json (`record`), residuals.csv, models/*.json and the
/// report into a folder; of several components residuals/COMPONENT.csv and
/// models/COMPONENT/*.json.
/// Throws std::system_error naming the path that could not be written.
void WriteOutputs(const StudyRun& run,
                  const models::StudyRecord& record,
                  const std::string& folder);

/// Held-out residual table: one line per hold-out, fold and test row, with
/// group, target and each model's prediction (empty where it failed).
std::string ResidualsCsv(const Comparison& comparison);

}  // namespace errmap::cli
