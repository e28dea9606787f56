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

/// How maps are compared; what is left empty is chosen as `errmap compare`
/// chooses it.
struct ComparisonOptions {
  std::vector<std::string> holdouts = {};  // SPECs; empty: DefaultHoldouts
  std::vector<std::string> models = {};    // SPECs; empty: all that suit
  std::optional<double> goal = {};         // RMSE wanted, in the target's unit
  /// Difference in RMSE that never matters; else DefaultIndifference.
  std::optional<double> indifference = {};
  std::uint64_t seed = 1;
  int jobs = 1;                             // at least 1; changes no figure
  const std::atomic<bool>* stop = nullptr;  // ends the study where it is set
  /// Told of each fit, from any thread; may be empty.
  std::function<void(const FitProgress&)> progress = {};
};

/// The whole study of one component, as `errmap compare FILE` does it: reads
/// the CSV file, holds rows out, fits every model, judges them and gives the
/// maps what they may promise. It has the file's name without its ending. With
/// MakeComponentRecord or report::MakeRecord it becomes results.json.
/// Throws data::InputError where the data cannot be used,
/// std::invalid_argument for a SPEC that is wrong or that the data do not
/// allow.
ComponentStudy CompareMaps(const std::string& file,
                           const data::DatasetSelection& selection,
                           const ComparisonOptions& options);

/// The same of measurements in memory, beside others a caller's own recipes.
/// The component has the name that the data set gives as its source, and a map
/// may be held against a file (`file:TEST.csv`) by the columns of the data set.
ComponentStudy CompareMaps(const data::Dataset& dataset,
                           const ComparisonOptions& options,
                           OwnRecipes own = {});

/// What reads other rows with the columns of `like` (target, inputs, groups),
/// else by `selection`, to be judged only.
data::DatasetSelection SelectionLike(const data::Dataset& like,
                                     data::DatasetSelection selection);

}  // namespace errmap::models
