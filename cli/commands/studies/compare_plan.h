#pragma once

#include <optional>

#include "cli/commands/studies/compare_arguments.h"
#include "cli/desk/machine/machine_study.h"
#include "cli/desk/plan/study_plan.h"
#include "cli/desk/toml/study_file.h"

namespace errmap::cli {

// What the command line asks for; each throws UsageError where it is wrong.

/// The study file of --config with what the command line says in place of its
/// words.
desk::StudyFile ConfigOfFile(const CompareArguments& arguments);

/// The machine of --machine, if there is one; DATA is then the folder of its
/// components' data.
std::optional<desk::MachineStudy> MachineOf(const CompareArguments& arguments);

/// What is to be fitted: of the machine, of the study file or of DATA; of the
/// two last `own` (may be empty) beside it.
desk::StudyPlan PlanOf(const CompareArguments& arguments,
                       const std::optional<desk::MachineStudy>& machine,
                       const desk::MakeOwnRecipes& own = {});

}  // namespace errmap::cli
