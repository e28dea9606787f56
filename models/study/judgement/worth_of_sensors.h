#pragma once

#include <cstddef>
#include <optional>

#include "models/study/judgement/choice.h"
#include "models/study/judgement/holdout_comparison.h"
#include "models/study/study.h"

namespace errmap::models {

/// Compares a map with the baselines without sensors (zero, mean, a curve over
/// the position). Returns the best of these if the map is not worth its
/// sensors; nothing if it is worth them, or has none.
///
/// A map is worth its sensors if it passes two checks against each such
/// baseline. Its error is a tenth lower. The mean log ratio of the units'
/// errors is below zero by more than its standard error. In 139 data sets of
/// noise, or of noise about a curve over the position, one map passes. Without
/// the tenth and the standard error, 21 would. Maps of real machines and
/// instruments pass easily: their errors are 0.1 to 0.7 times as large
/// (tests/benchmarks/worth_of_sensors.py).
std::optional<std::size_t> BetterWithoutSensors(
    std::size_t model,
    const HoldoutComparison& comparison,
    const StudyResult& study,
    const Wanted& is_map);

}  // namespace errmap::models
