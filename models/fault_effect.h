#pragma once

#include <vector>

#include "data/measurements/dataset.h"

namespace errmap::models {

/// What faulty readings do to a fit, shown on a plain linear map of all inputs
/// (ordinary least squares): its RMSE on the rows that are sound, target's
/// unit. NaN where such a map cannot be fitted.
struct FaultEffect {
  double rmse_with = 0.0;     // fitted with the readings
  double rmse_without = 0.0;  // fitted without them
};

/// Of these data rows of the file.
FaultEffect EffectOfRows(const data::Dataset& dataset,
                         const std::vector<Eigen::Index>& rows);

/// Of an input as a whole; all rows are sound then.
FaultEffect EffectOfInput(const data::Dataset& dataset, Eigen::Index input);

}  // namespace errmap::models
