#pragma once

#include <optional>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/map_experience.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Makes the record of a map fitted to these rows. Returns nothing if readings,
/// with or without their error, do not distinguish the rows.
std::optional<LearntRows> MakeLearntRows(const FittedModel& fitted,
                                         const data::Dataset& training);

/// Returns how many of these rows the map was fitted to, according to its file.
/// `inputs` (m x inputs of the map) and `targets` (m; null: readings alone) are
/// in its units. Returns 0 if chance and false hits of the filter (LearntRows)
/// explain them, or for one or two readings alone. For a long training file it
/// is an estimate from some of its rows.
Index CountLearntRows(const FittedModel& fitted,
                      const MatrixXd& inputs,
                      const VectorXd* targets);

}  // namespace errmap::models
