#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/study/given_predictions.h"
#include "models/study/record/component_study.h"
#include "models/study/study.h"

namespace errmap::models {

/// Options of a comparison. For empty ones, the defaults of `errmap compare`
/// apply.
struct ComparisonOptions {
  std::vector<std::string> holdouts = {};  // SPECs; empty: DefaultHoldouts
  std::vector<std::string> models = {};    // SPECs; empty: all that suit
  std::optional<double> goal = {};         // wanted RMSE, in the target's unit
  /// Difference in RMSE that does not matter; empty: DefaultIndifference.
  std::optional<double> indifference = {};
  std::uint64_t seed = 1;
  int jobs = 1;  // at least 1; does not change results
  const std::atomic<bool>* stop = nullptr;  // ends the study once it is set
  /// Called at each fit, from any thread; may be empty.
  std::function<void(const FitProgress&)> progress = {};
};

/// The caller's own recipes in a study.
struct OwnRecipes {
  std::vector<std::unique_ptr<ModelRecipe>> recipes = {};
  /// True: if no SPECs are given, they are added to the default models.
  bool beside_defaults = false;
};

/// Runs the whole study of one component, as `errmap compare FILE` does. Reads
/// the CSV file, holds out rows, fits and judges every model, and adds the
/// predicted errors to the maps. The component has the file's name without its
/// extension. MakeComponentRecord or report::MakeRecord turns it into
/// results.json. Throws data::InputError if the data cannot be used,
/// std::invalid_argument if a SPEC is wrong or the data do not allow it.
ComponentStudy CompareMaps(const std::string& file,
                           const data::DatasetSelection& selection,
                           const ComparisonOptions& options);

/// Runs the study for measurements in memory; a caller may add recipes. The
/// data set's source becomes the component's name. A hold-out `file:TEST.csv`
/// needs the data set's columns.
ComponentStudy CompareMaps(const data::Dataset& dataset,
                           const ComparisonOptions& options,
                           OwnRecipes own = {});

/// Returns a selection for reading test rows. It takes the columns (target,
/// inputs, groups) of `like`, and all else from `selection`.
data::DatasetSelection SelectionLike(const data::Dataset& like,
                                     data::DatasetSelection selection);

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
