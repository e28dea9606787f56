#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/desk/provenance.h"
#include "cli/desk/study_config.h"
#include "models/comparison/component_plan.h"

namespace errmap::desk {

using models::ComponentPlan;

/// What a study will do: everything is read, nothing is fitted.
struct StudyPlan {
  /// With what the defaults became: names, targets, inputs, groups, goals;
  /// hold-outs and models where all components have the same.
  StudyConfig config;
  std::vector<InputFile> inputs;  // every file read, in order
  std::vector<models::ComponentPlan> components;

  int num_fits() const;
  /// Paths of all files read, those of "file:" models among them.
  std::vector<std::string> InputPaths() const;
};

/// Told of what may be worth knowing, a line at a time.
using Remark = std::function<void(const std::string&)>;

/// Makes recipes of a caller's own for a component.
using MakeOwnRecipes = std::function<models::OwnRecipes()>;

/// Reads the data, makes the hold-outs and chooses models where the user left
/// them to us, `own` (may be empty) beside them. `remark` is told what was
/// found in the data, what is left out and why; where it is empty, that is not
/// looked into. Throws data::InputError where data cannot be used or two
/// components have one name, std::invalid_argument for a SPEC that the
/// catalogue does not know.
StudyPlan PlanStudy(const StudyConfig& config,
                    const Remark& remark = {},
                    const MakeOwnRecipes& own = {});

}  // namespace errmap::desk
