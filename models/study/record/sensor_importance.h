#pragma once

#include <optional>

#include "models/study/record/recommendation_record.h"
#include "models/study/study.h"

namespace errmap::models {

/// Takes the sensors of `fitted` (the map of all rows) away from the maps of
/// the folds in `result`: in a sensor's place they read what the others that
/// they read say of it, by linear regression over the fold's training rows.
/// Nothing is fitted anew, so one that is fitted without the sensor may do
/// better. Every so-manieth held-out row serves where all would take more than
/// some seconds. None for a map without sensors, for results without maps, for
/// readings whose squares overflow, where a memory would run through too long a
/// log, and where `stop` is set.
std::optional<SensorImportance> ImportanceOfSensors(
    const data::Dataset& dataset,
    const Holdout& holdout,
    const HoldoutResult& result,
    const FittedModel& fitted,
    const std::atomic<bool>* stop);

}  // namespace errmap::models
