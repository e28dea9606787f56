#pragma once

#include <string>
#include <vector>

#include "cli/commands/studies/compare_arguments.h"
#include "cli/desk/plan/study_plan.h"
#include "cli/desk/study_options.h"
#include "cli/desk/toml/study_file.h"

namespace errmap::cli {

// What the command line asks for. Each function throws UsageError if the
// command line is wrong.

/// Reads the study file of --config, changed by --set and by the flags of the
/// command line.
desk::StudyFile ConfigOfFile(const CompareArguments& arguments);

/// Returns the study of one component that the options alone describe.
desk::StudyConfig ConfigOf(const CompareArguments& arguments);

/// Returns the given flags that cannot apply to as many components as `reach`.
std::vector<std::string> GivenOfFewer(const CompareArguments& arguments,
                                      desk::Reach reach);

/// Returns what to fit, as a slice's mode, the study file or DATA says. `own`
/// (may be empty) adds recipes of the caller.
desk::StudyPlan PlanOf(const CompareArguments& arguments,
                       const desk::MakeOwnRecipes& own = {});

}  // namespace errmap::cli
