#pragma once

#include <vector>

#include "data/measurements/dataset.h"

namespace errmap::models {

/// What faulty readings do to a plain linear map of all inputs (ordinary least
/// squares): its RMSE, target's unit. NaN where such a map cannot be fitted.
struct FaultEffect {
  double rmse_with = 0.0;     // fitted with the readings
  double rmse_without = 0.0;  // fitted without them
};

/// Of these data rows of the file, on the sound rows.
FaultEffect EffectOfRows(const data::Dataset& dataset,
                         const std::vector<Eigen::Index>& rows);

/// Of an input as a whole, on rows held out by sessions, else groups, else
/// blocks: rows that it was fitted to have nothing against an input. Of more
/// than 2000 rows some 2000 are taken, spread evenly.
FaultEffect EffectOfInput(const data::Dataset& all_rows, Eigen::Index input);

}  // namespace errmap::models
