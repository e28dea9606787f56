#pragma once

#include <cstddef>
#include <optional>

#include "models/study/judgement/choice.h"
#include "models/study/judgement/holdout_comparison.h"
#include "models/study/study.h"

namespace errmap::models {

/// To do nothing, or to go by the position alone, is a map, too: the baseline
/// without sensors (zero, mean, a curve over the position) that a map with
/// sensors is not worth its sensors beside; nothing where it is, or has none.
///
/// It is worth them where its error is lower by a tenth than that of each such
/// baseline, and the logarithm of its unit's error over the baseline's is below
/// zero by more than its standard error over the units. On 139 sets of noise,
/// or of noise about a curve over the position, one map passes; without the
/// tenth and the standard error 21 do. Maps of real machines and instruments
/// pass by far: their errors are 0.1 to 0.7 times as large
/// (tests/benchmarks/worth_of_sensors.py).
std::optional<std::size_t> BetterWithoutSensors(
    std::size_t model,
    const HoldoutComparison& comparison,
    const StudyResult& study,
    const Wanted& is_map);

}  // namespace errmap::models
