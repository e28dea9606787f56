#pragma once

#include <optional>
#include <vector>

#include "models/study/judgement/holdout_comparison.h"
#include "models/study/study.h"

namespace errmap::models {

/// Returns the hold-out for predicted errors, as an index into `holdouts`. Even
/// two sessions show more about a third one than any number of groups within
/// them. Nothing if all failed.
std::optional<std::size_t> StrictestHoldout(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons);

/// Returns the hold-out that chooses a map. With fewer than
/// kFewestSessionsToDecide sessions a fold lacks too much of the data, and
/// groups distinguish maps better.
std::optional<std::size_t> DecisiveHoldout(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons);

/// Returns the hold-out that predicts later sessions; null if there is none.
const HoldoutComparison* ForwardOverSessions(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons);

}  // namespace errmap::models
