#pragma once

#include <string>

#include "models/error_model.h"
#include "models/session/zero_schedule.h"

namespace errmap::report {

/// Returns a table of a map's errors (with held_out) on unseen sessions by the
/// time between probes, and advice below it. `goal`: target's unit; NaN: no
/// advice.
std::string WhenText(const models::ZeroSchedule& schedule,
                     const models::FittedModel& fitted,
                     double goal);

/// Returns only the advice.
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
