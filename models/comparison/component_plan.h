#pragma once

#include <memory>
#include <string>
#include <vector>

#include "models/error_model.h"
#include "models/study/given_predictions.h"
#include "models/study/record/component_study.h"

namespace errmap::models {

/// A component with its data and all models that will be fitted to them.
struct ComponentPlan {
  /// Has no results yet.
  ComponentStudy comparison;
  std::vector<std::unique_ptr<ModelRecipe>> recipes;
  std::vector<GivenPredictions> given;  // judged with the fitted models

  std::vector<std::string> HoldoutNames() const;
  std::vector<std::string> ModelNames() const;
  /// Number of fits: every model to all rows and to every fold.
  int num_fits() const;
};

/// The caller's own recipes in a study.
struct OwnRecipes {
  std::vector<std::unique_ptr<ModelRecipe>> recipes = {};
  /// True: if no SPECs are given, they are added to the default models.
  bool beside_defaults = false;
};

/// Plans the fits of a component that has its data and hold-outs. The models
/// are those of `specs` and `own`, or by default all that suit the data, and
/// the baselines that any map must beat. `left_out` (may be null) receives one
/// line for each unsuitable default model, with the reason. Throws
/// std::invalid_argument if a SPEC is wrong, data::InputError naming the
/// component's file if a fold trains on fewer than two rows.
ComponentPlan PlanModels(ComponentStudy component,
                         const std::vector<std::string>& specs,
                         std::vector<std::string>* left_out,
                         OwnRecipes own = {});

/// Fits the planned models, judges them and adds the predicted errors to the
/// maps. For the recommended map, also finds the sensors that it needs and the
/// value of another session. The results go into plan->comparison. If
/// options.stop ended the run, only finished ones do. Keeps the maps fitted to
/// folds (FoldResult::map) if `keep_fold_maps` is set.
void RunComponent(ComponentPlan* plan,
                  StudyOptions options,
                  bool keep_fold_maps = false);

}  // namespace errmap::models
