#pragma once

#include <memory>
#include <string>
#include <vector>

#include "models/error_model.h"
#include "models/study/given_predictions.h"
#include "models/study/record/component_study.h"

namespace errmap::models {

/// A component with its data read and all that will be fitted to them.
struct ComponentPlan {
  /// Still without results.
  ComponentStudy comparison;
  std::vector<std::unique_ptr<ModelRecipe>> recipes;
  std::vector<GivenPredictions> given;  // judged beside them

  std::vector<std::string> HoldoutNames() const;
  std::vector<std::string> ModelNames() const;
  /// Fits of every model to all rows and to every fold.
  int num_fits() const;
};

/// Recipes of the caller's own that take part in a study.
struct OwnRecipes {
  std::vector<std::unique_ptr<ModelRecipe>> recipes = {};
  /// Beside all that suit the data, where no others are named.
  bool beside_defaults = false;
};

/// What is to be fitted to a component that has its data and hold-outs: the
/// models of `specs` and `own`, or where there are none all that suit the data,
/// and the baselines that any map must beat. `left_out` (may be null) is told
/// in a line each which of the default ones do not suit, and why. Throws
/// std::invalid_argument where a SPEC is wrong, data::InputError naming the
/// component's file where a fold trains on fewer than two rows.
ComponentPlan PlanModels(ComponentStudy component,
                         const std::vector<std::string>& specs,
                         std::vector<std::string>* left_out,
                         OwnRecipes own = {});

/// Fits what is planned, judges it, and gives the maps what they may promise;
/// of the recommended one also finds which sensors it needs and what another
/// session would be worth. All goes into plan->comparison; of a run that
/// options.stop ended, what was finished. What is fitted to the folds is kept
/// (FoldResult::map) where `keep_fold_maps`.
void RunComponent(ComponentPlan* plan,
                  StudyOptions options,
                  bool keep_fold_maps = false);

}  // namespace errmap::models
