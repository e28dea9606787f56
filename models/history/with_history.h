#pragma once

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/history/history.h"

namespace errmap::models {

/// Returns a model fitted to DeriveDataset(training, history) as a map from the
/// columns of `training`. It keeps the part of the history that its form needs,
/// with the columns for that as inputs, and the guards.
FittedModel WithHistory(FittedModel fitted,
                        const data::Dataset& training,
                        const History& history);

/// Returns true if its filters count rows, which a controller does not have.
bool CountsRows(const FittedModel& fitted);

/// Returns such a map for rows that come every `seconds` (above 0), with
/// filters in seconds. Predictions for rows at this interval do not change.
/// Returns other maps unchanged.
FittedModel WithRowsEvery(FittedModel fitted, double seconds);

}  // namespace errmap::models
