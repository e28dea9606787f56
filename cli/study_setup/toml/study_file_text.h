#pragma once

#include <string>

#include "cli/study_setup/plan/study_plan.h"
#include "data/csv.h"

namespace errmap::study_setup {

/// Proposes a study of one data file: one component, or one for each value of a
/// column that names directions, slides or components (`direction`, `axis`, ...
/// with few distinct values).
StudyConfig ProposeStudy(const data::CsvTable& table);

/// Returns a study file for the plan, with comments on the findings and on
/// every key. `data` is the data file as seen from the study file's folder.
/// `usage` is the command for such a study, shown in the first line. Reading
/// the file gives the same study as the plan.
std::string StudyFileText(const StudyPlan& plan,
                          const std::string& data,
                          const std::string& usage);

}  // namespace errmap::study_setup
