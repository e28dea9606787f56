#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/study_setup/provenance.h"
#include "cli/study_setup/study_config.h"
#include "models/comparison/compare.h"

namespace errmap::study_setup {

using models::ComponentPlan;

/// The plan of a study: all data are read, nothing is fitted yet.
struct StudyPlan {
  /// The configuration with its defaults filled in: names, targets, inputs,
  /// groups, goals. Contains hold-outs and models only if all components have
  /// the same.
  StudyConfig config;
  std::vector<InputFile> inputs;  // every file read, in order
  std::vector<models::ComponentPlan> components;

  int num_fits() const;
  /// Returns the paths of all files read, including those of "file:" models.
  std::vector<std::string> InputPaths() const;
};

/// Returns the study in the form that PlanStudy needs. A component with both
/// directions of motion becomes two, with the direction added to the name. A
/// component whose data cannot be read stays unchanged.
StudyConfig PartedByDirection(StudyConfig config);

/// Receives remarks for the user, one line at a time.
using Remark = std::function<void(const std::string&)>;

/// Makes the caller's own recipes for a component.
using MakeOwnRecipes = std::function<models::OwnRecipes()>;

/// Reads the data, makes the hold-outs, and chooses models if the user named
/// none. `own` (may be empty) adds recipes. `remark` receives findings about
/// the data, including what is left out and why. If it is empty, the data are
/// not examined for remarks. Throws data::InputError if data cannot be used or
/// two components have the same name, and std::invalid_argument for a SPEC that
/// the catalogue does not know.
StudyPlan PlanStudy(const StudyConfig& config,
                    const Remark& remark = {},
                    const MakeOwnRecipes& own = {});

}  // namespace errmap::study_setup
