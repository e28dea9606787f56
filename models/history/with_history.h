#pragma once

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/history/history.h"

namespace errmap::models {

/// A model that was fitted to DeriveDataset(training, history), as a map from
/// the columns of `training`: it carries the part of the history that its form
/// reads, and its inputs are the columns which that needs. Guards stay.
FittedModel WithHistory(FittedModel fitted,
                        const data::Dataset& training,
                        const History& history);

/// Whether its filters count rows, which only training files have.
bool CountsRows(const FittedModel& fitted);

/// Such a map where a row comes every `seconds` (above 0): its filters run in
/// seconds, and errors of rows that come so are the same. Other maps as they
/// are.
FittedModel WithRowsEvery(FittedModel fitted, double seconds);

}  // namespace errmap::models
