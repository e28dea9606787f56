#pragma once

#include <optional>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/map_experience.h"
#include "models/study/study.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Returns the errors of a model's predictions of `holdout`'s held-out rows;
/// nothing if PredictionIntervalOf returns nothing. `inputs` are those that the
/// map reads: in use, only their temperatures can show when the next probe is
/// due. The position of a probe is always known, so it may be a column that the
/// map does not read.
std::optional<HeldOutErrors> HeldOutErrorsOf(
    const data::Dataset& dataset,
    const Holdout& holdout,
    const HoldoutResult& result,
    const std::vector<TrainedInput>& inputs);

/// Returns the time of each row since the first row of its session; zeros
/// without a log.
VectorXd ElapsedOf(const data::Dataset& dataset);

}  // namespace errmap::models
