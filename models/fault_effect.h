#pragma once

#include <vector>

#include "data/measurements/dataset.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Effect of faulty readings on a plain linear map of all inputs (ordinary
/// least squares). RMSE is in the target's unit, NaN if the map cannot be
/// fitted.
struct FaultEffect {
  double rmse_with = 0.0;     // fitted with the readings
  double rmse_without = 0.0;  // fitted without them
};

/// Returns the effect of these data rows of the file, tested on the other rows.
FaultEffect EffectOfRows(const data::Dataset& dataset,
                         const std::vector<Index>& rows);

/// Returns the effect of a whole input, tested on rows held out by sessions,
/// else groups, else blocks. In the training rows, an input can only reduce the
/// error. Uses at most 2000 rows, spread evenly.
FaultEffect EffectOfInput(const data::Dataset& all_rows, Index input);

}  // namespace errmap::models
