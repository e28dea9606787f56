#pragma once

#include <string>

#include "models/error_model.h"
#include "models/session/zero_schedule.h"

namespace errmap::report {

/// Says what the errors of a map (with held_out) on unseen sessions mean for
/// the time between probes: a table, and the advice below it. `goal`: target's
/// unit; NaN: no advice.
std::string WhenText(const models::ZeroSchedule& schedule,
                     const models::FittedModel& fitted,
                     double goal);

/// The advice alone.
std::string ZeroAdvice(const models::ZeroSchedule& schedule,
                       const models::FittedModel& fitted,
                       double goal);

/// Describes in one sentence the state `age` (s) and `change` (temperature's
/// unit) after a probe.
std::string ZeroDueText(const models::ZeroTrigger& advised,
                        const models::HeldOutErrors& errors,
                        double age,
                        double change);

}  // namespace errmap::report
