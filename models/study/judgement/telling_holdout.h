#pragma once

#include <optional>
#include <vector>

#include "models/study/judgement/holdout_comparison.h"
#include "models/study/study.h"

namespace errmap::models {

/// What a promise is made by, index into `holdouts`: two sessions say more of a
/// third than any number of groups of the same days. Nothing where all failed.
std::optional<std::size_t> StrictestHoldout(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons);

/// What a map is chosen by: with fewer than kFewestSessionsToDecide sessions a
/// fold lacks too much of what all rows have, and its errors tell maps apart
/// less well than groups do.
std::optional<std::size_t> DecisiveHoldout(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons);

/// Null where no later sessions were foretold.
const HoldoutComparison* ForwardOverSessions(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons);

}  // namespace errmap::models
