#pragma once

#include <string>

#include "cli/desk/plan/study_plan.h"
#include "data/csv.h"

namespace errmap::desk {

/// Proposes a study of one data file: one component, or one for each value of a
/// column that tells directions, slides or components apart (`direction`,
/// `axis`, ... with few distinct values).
StudyConfig ProposeStudy(const data::CsvTable& table);

/// Returns a study file for the plan, with comments on what was found and what
/// every key does. `data` is the data file as seen from the study file's
/// folder. `usage` is the command for such a study; it is shown in the first
/// line. The file, read again, gives the same study as the plan.
std::string StudyFileText(const StudyPlan& plan,
                          const std::string& data,
                          const std::string& usage);

}  // namespace errmap::desk
