#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "models/study/judgement/choice.h"
#include "models/study/judgement/holdout_comparison.h"
#include "models/study/study.h"

namespace errmap::models {

/// Returns the hold-out for predicted errors, as an index into `holdouts`. Two
/// sessions say more of a third than any number of groups of the same days.
/// Nothing if all failed.
std::optional<std::size_t> StrictestHoldout(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons);

/// Returns the hold-out that chooses a map. With fewer than
/// kFewestSessionsToDecide sessions a fold lacks too much of the data, and
/// groups tell maps apart better.
std::optional<std::size_t> DecisiveHoldout(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons);

/// Returns null if no later sessions were predicted.
const HoldoutComparison* ForwardOverSessions(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons);

/// The average of maps, or a simpler map.
struct BlendOrSimpler {
  std::size_t model = 0;  // index into StudyResult::models
  const HoldoutComparison* vetoed_by = nullptr;  // null: no veto
};

/// An average of maps with different input views is safer than one choice
/// among near-equals. It is used unless separate days establish that a
/// single map is better. It is not used if a baseline beats it, in later
/// sessions too if these were predicted. Folds lack sessions, so a map of
/// many columns looks worse there than it is: a veto needs more than twice
/// the error.
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
/// sensors; nothing if it is, or has none.
///
/// A map is worth its sensors if it passes two checks against each such
/// baseline. Its error is a tenth lower. The mean log ratio of the units'
/// errors is below zero by more than its standard error. Of 139 sets of noise,
/// or of noise about a curve over the position, one map passes; without the
/// tenth and the standard error 21 do. Maps of real machines and instruments
/// pass easily: their errors are 0.1 to 0.7 times as large
/// (tests/benchmarks/worth_of_sensors.py).
std::optional<std::size_t> BetterWithoutSensors(
    std::size_t model,
    const HoldoutComparison& comparison,
    const StudyResult& study,
    const Wanted& is_map);

}  // namespace errmap::models
