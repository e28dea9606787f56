#pragma once

#include <vector>

#include <Eigen/Core>

#include "cli/desk/plan/study_run.h"
#include "models/study/record/study_record.h"

namespace errmap::cli {

/// How many probes a session gets, and how far apart.
struct ProbeArguments {
  std::vector<Eigen::Index> numbers;  // empty: not asked for
  double spacing = 600.0;             // s; in rows, where time is the row: 1
};

/// Puts into the record of each component with a recommendation what probes
/// would make of its models under the hold-out that decides. Says on stderr
/// where the data do not allow it.
void AddProbes(const desk::StudyRun& run,
               const ProbeArguments& arguments,
               models::StudyRecord* record);

}  // namespace errmap::cli
