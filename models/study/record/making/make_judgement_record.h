#pragma once

#include <optional>

#include "models/study/record/component_study.h"
#include "models/study/record/study_record.h"

namespace errmap::models {

/// 95 % of the error of a model under a hold-out; NaN where two units bound
/// nothing.
IntervalRecord RmseInterval(const HoldoutComparison& tests, std::size_t model);

/// Nothing where there is no goal or it could not be judged.
std::optional<bool> MeetsGoal(GoalStanding standing);

/// What hold-outs say of the models beside each other, and of the recommended
/// one by itself. Its cost, grounds and doubts are others' to add.
void AddJudgement(const ComponentStudy& study, ComponentRecord* record);

/// Of a component that was scored with its offset set anew.
RezeroRecord MakeRezeroRecord(const ComponentStudy& study);

}  // namespace errmap::models
