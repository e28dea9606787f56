#pragma once

#include <string>
#include <vector>

#include "cli/desk/plan/study_plan.h"

namespace errmap::cli {

/// Returns what a study would do, for a terminal: components, rows, groups,
/// hold-outs, models, the number of fits, and a rough time on `jobs`
/// processors. Then the files that would be written into `out` ("": none).
std::string PlanText(const desk::StudyPlan& plan,
                     int jobs,
                     const std::string& out);

/// Returns how long a study takes; nothing below half a minute. Unless its
/// models were `chosen`, also names the faster ones, which together take at
/// most a quarter of that time.
std::vector<std::string> LongRunLines(const desk::StudyPlan& plan,
                                      int jobs,
                                      bool chosen);

}  // namespace errmap::cli
