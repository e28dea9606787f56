#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/desk/plan/study_plan.h"
#include "cli/desk/plan/study_run.h"
#include "models/study/record/study_record.h"

namespace errmap::desk {

/// Names of the files that WriteRunFiles may make of a study: results.json,
/// residuals.csv and models/*.json; of several components
/// residuals/COMPONENT.csv and models/COMPONENT/*.json.
std::vector<std::string> RunFileNames(const StudyPlan& plan);

/// Says of each map in `record` which file WriteRunFiles makes of it.
void NameMaps(const StudyRun& run, models::StudyRecord* record);

/// The text of a map's file: that of all rows, with the rows that it is made
/// for and where it comes from. The model must have been fitted to all rows.
std::string MapFileText(const StudyRun& run,
                        const models::ComponentStudy& component,
                        const models::ModelResult& model);

/// Takes a file's name, relative to the folder of all, and its content.
using WriteFile =
    std::function<void(const std::string& name, std::string_view content)>;

/// Gives `write` results.json (`record`), the residuals and every map.
void WriteRunFiles(const StudyRun& run,
                   const models::StudyRecord& record,
                   const WriteFile& write);

}  // namespace errmap::desk
