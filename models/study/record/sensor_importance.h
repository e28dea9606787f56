#pragma once

#include <optional>

#include "models/study/record/recommendation_record.h"
#include "models/study/study.h"

namespace errmap::models {

/// Removes the sensors of `fitted` (the map of all rows) from the folds'
/// maps in `result`. A linear regression on the fold's training rows
/// replaces a sensor's reading by its estimate from the map's other inputs.
/// Nothing is refitted, so a map fitted without the sensor may do better.
/// Uses every n-th held-out row if all would take more than some seconds.
/// Returns nothing for a map without sensors, results without maps, readings
/// whose squares overflow, or a memory over too long a log; nor if `stop` is
/// set.
std::optional<SensorImportance> ImportanceOfSensors(
    const data::Dataset& dataset,
    const Holdout& holdout,
    const HoldoutResult& result,
    const FittedModel& fitted,
    const std::atomic<bool>* stop);

}  // namespace errmap::models
