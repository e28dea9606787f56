#pragma once

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/history/history.h"

namespace errmap::models {

/// Returns a model fitted to DeriveDataset(training, history) as a map from the
/// columns of `training`. It has the part of the history that its form needs,
/// and the columns for that as inputs. Guards are kept.
FittedModel WithHistory(FittedModel fitted,
                        const data::Dataset& training,
                        const History& history);

/// Returns true if its filters count rows. Only training files have rows.
bool CountsRows(const FittedModel& fitted);

/// Returns such a map for rows that come every `seconds` (above 0). Its filters
/// then run in seconds. Errors of rows at this interval do not change. Returns
/// other maps unchanged.
FittedModel WithRowsEvery(FittedModel fitted, double seconds);

}  // namespace errmap::models
