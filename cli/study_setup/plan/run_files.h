#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/study_setup/plan/study_plan.h"
#include "cli/study_setup/plan/study_run.h"
#include "models/study/record/study_record.h"

namespace errmap::study_setup {

/// Returns the names of all files that WriteRunFiles may write for a study:
/// results.json, residuals.csv and models/*.json. With several components:
/// residuals/COMPONENT.csv and models/COMPONENT/*.json.
std::vector<std::string> RunFileNames(const StudyPlan& plan);

/// Sets the file name of each map in `record`, as WriteRunFiles writes it.
void NameMaps(const StudyRun& run, models::StudyRecord* record);

/// Returns the text of a map's file: the map fitted to all rows, the rows for
/// which it is made, and its provenance. The model must have been fitted to all
/// rows.
std::string MapFileText(const StudyRun& run,
                        const models::ComponentStudy& component,
                        const models::ModelResult& model);

/// Writes a file: its name, relative to the output folder, and its content.
using WriteFile =
    std::function<void(const std::string& name, std::string_view content)>;

/// Passes results.json (`record`), the residuals and every map to `write`.
void WriteRunFiles(const StudyRun& run,
                   const models::StudyRecord& record,
                   const WriteFile& write);

}  // namespace errmap::study_setup
