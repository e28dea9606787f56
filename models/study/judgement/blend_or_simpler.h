#pragma once

#include <cstddef>
#include <optional>

#include "models/study/judgement/choice.h"
#include "models/study/judgement/holdout_comparison.h"
#include "models/study/study.h"

namespace errmap::models {

/// Chooses between the average of maps and a simpler map.
struct BlendOrSimpler {
  std::size_t model = 0;  // index into StudyResult::models
  const HoldoutComparison* vetoed_by = nullptr;  // null: no veto
};

/// An average of maps with different input views is safer than one choice among
/// near-equals. It is used unless separate days establish that a single map is
/// better, or a baseline beats it (in later sessions, too, if these were
/// predicted). Folds lack sessions, so a map of many columns looks worse there
/// than it is. So a simple map can veto it only if its error is less than half
/// as large.
///
/// `decides` chooses among the models that `is_map` accepts. `strictest` and
/// `forward` (which may be null) can veto.
BlendOrSimpler ChooseBlendOrSimpler(std::size_t blend,
                                    const HoldoutComparison& decides,
                                    const HoldoutComparison& strictest,
                                    const HoldoutComparison* forward,
                                    const StudyResult& study,
                                    const Wanted& is_map);

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
