#pragma once

#include <optional>

#include "cli/commands/studies/compare_arguments.h"
#include "cli/study_file/machine/machine_study.h"
#include "cli/study_file/plan/study_plan.h"
#include "cli/study_file/toml/study_file.h"

namespace errmap::cli {

// What the command line asks for; each throws UsageError where it is wrong.

/// The study file of --config with what the command line says in place of its
/// words.
StudyFile ConfigOfFile(const CompareArguments& arguments);

/// The machine of --machine, if there is one; DATA is then the folder of its
/// components' data.
std::optional<MachineStudy> MachineOf(const CompareArguments& arguments);

/// What is to be fitted: of the machine, of the study file or of DATA.
StudyPlan PlanOf(const CompareArguments& arguments,
                 const std::optional<MachineStudy>& machine);

}  // namespace errmap::cli
