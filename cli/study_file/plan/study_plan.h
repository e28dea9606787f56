#pragma once

#include <string>
#include <vector>

#include "cli/study_file/comparison.h"
#include "cli/study_file/study_config.h"
#include "models/comparison/component_plan.h"

namespace errmap::cli {

using models::ComponentPlan;

/// What a study will do: everything is read, nothing is fitted.
struct StudyPlan {
  /// With what the defaults became: names, targets, inputs, groups, goals;
  /// hold-outs and models where all components have the same.
  StudyConfig config;
  std::vector<InputFile> inputs;  // every file read, in order
  std::vector<ComponentPlan> components;

  int num_fits() const;
  /// Paths of all files read, those of "file:" models among them.
  std::vector<std::string> InputPaths() const;
};

/// Reads the data, makes the hold-outs and chooses models where the user left
/// them to us. Says on stderr what is left out and why (`quiet`: only what
/// limits the answer). Throws data::InputError where data cannot be used or
/// two components have one name, std::invalid_argument for a SPEC that the
/// catalogue does not know.
StudyPlan PlanStudy(const StudyConfig& config, bool quiet);

}  // namespace errmap::cli
