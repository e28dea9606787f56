#pragma once

#include <optional>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/map_experience.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Of a map as it was fitted to these rows; nothing where neither readings with
/// their error nor readings alone tell one row from another.
std::optional<LearntRows> MakeLearntRows(const FittedModel& fitted,
                                         const data::Dataset& training);

/// How many of these rows the map learnt from, as its file knows them: `inputs`
/// (m x inputs of the map) and `targets` (m; null: readings alone) in its
/// units. 0 where they are no more than chance and the filter's false hits
/// (LearntRows) would make, or one or two readings alone; of a long training an
/// estimate from some of them.
Index CountLearntRows(const FittedModel& fitted,
                      const MatrixXd& inputs,
                      const VectorXd* targets);

}  // namespace errmap::models
