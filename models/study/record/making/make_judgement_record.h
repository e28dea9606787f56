#pragma once

#include <optional>

#include "models/study/record/component_study.h"
#include "models/study/record/study_record.h"

namespace errmap::models {

/// Returns the 95 % interval of a model's RMSE under a hold-out; NaN if there
/// are too few units.
IntervalRecord RmseInterval(const HoldoutComparison& tests, std::size_t model);

/// Returns nothing if there is no goal or it could not be judged.
std::optional<bool> MeetsGoal(GoalStanding standing);

/// Adds hold-out results: the models compared with each other, and the
/// recommended model on its own. The caller adds its cost, reasons and caveats.
void AddJudgement(const ComponentStudy& study, ComponentRecord* record);

/// Makes the record of a component that was judged with re-zeroing.
RezeroRecord MakeRezeroRecord(const ComponentStudy& study);

}  // namespace errmap::models
