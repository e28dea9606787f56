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

}  // namespace errmap::models
