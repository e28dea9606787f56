#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/study_file/comparison.h"
#include "cli/study_file/study_config.h"
#include "models/error_model.h"
#include "models/study/given_predictions.h"

namespace errmap::cli {

/// A component with its data read and all that will be fitted to them.
struct ComponentPlan {
  /// Still without results.
  Comparison comparison;
  std::vector<std::unique_ptr<models::ModelRecipe>> recipes;
  std::vector<models::GivenPredictions> given;  // judged beside them

  std::vector<std::string> HoldoutNames() const;
  std::vector<std::string> ModelNames() const;
  /// Fits of every model to all rows and to every fold.
  int num_fits() const;
};

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
