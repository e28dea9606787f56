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

/// Effect of these data rows of the file, judged on the sound rows.
FaultEffect EffectOfRows(const data::Dataset& dataset,
                         const std::vector<Index>& rows);

/// Effect of a whole input, judged on rows held out by sessions, else groups,
/// else blocks: an in-sample error never counts against an input. Uses at most
/// 2000 rows, spread evenly.
FaultEffect EffectOfInput(const data::Dataset& all_rows, Index input);

}  // namespace errmap::models
