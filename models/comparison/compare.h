#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/comparison/component_plan.h"
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

}  // namespace errmap::models
