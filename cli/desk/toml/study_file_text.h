#pragma once

#include <string>

#include "cli/desk/plan/study_plan.h"
#include "data/csv.h"

namespace errmap::desk {

/// A study of one data file: one component, or one per value of a column that
/// tells directions, slides or components apart (`direction`, `axis`, ... with
/// few distinct values).
StudyConfig ProposeStudy(const data::CsvTable& table);

/// A study file for the plan, commented: what was found and what every key
/// would do. `data` is the data file as seen from the study file's folder,
/// `usage` how such a study is run, for its first line. Read again, it asks for
/// what the plan does.
std::string StudyFileText(const StudyPlan& plan,
                          const std::string& data,
                          const std::string& usage);

}  // namespace errmap::desk
