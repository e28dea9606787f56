#pragma once

#include <string>

#include "data/units.h"
#include "models/session/zero_schedule.h"

namespace errmap::report {

/// Says what a map's errors on unseen sessions mean for the time between
/// probes: a table, and the advice below it. `goal`: target's unit; NaN: no
/// advice.
std::string WhenText(const models::ZeroSchedule& schedule,
                     const models::HeldOutErrors& errors,
                     const data::Unit& unit,
                     double goal);

/// The advice alone.
std::string ZeroAdvice(const models::ZeroSchedule& schedule,
                       const models::HeldOutErrors& errors,
                       const data::Unit& unit,
                       double goal);

/// Describes in one sentence the state `age` (s) and `change` (temperature's
/// unit) after a probe.
std::string ZeroDueText(const models::ZeroTrigger& advised,
                        const models::HeldOutErrors& errors,
                        double age,
                        double change);

}  // namespace errmap::report
