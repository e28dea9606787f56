#pragma once

#include <string>

#include "cli/desk/plan/study_plan.h"

namespace errmap::cli {

/// What a study would do, for a terminal: components, rows, groups, hold-outs,
/// models, number of fits, a rough time on `jobs` processors and the files
/// that would be written into `out` ("": none).
std::string PlanText(const desk::StudyPlan& plan,
                     int jobs,
                     const std::string& out);

}  // namespace errmap::cli
