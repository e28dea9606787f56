#pragma once

#include <string>

#include "data/units.h"
#include "models/session/zero_schedule.h"

namespace errmap::report {

/// What a map's errors on unseen sessions say of the time between probes, as a
/// table and the advice below it. `goal`: target's unit; NaN: no advice.
std::string WhenText(const models::ZeroSchedule& schedule,
                     const models::HeldOutErrors& errors,
                     const data::Unit& unit,
                     double goal);

/// The advice alone.
std::string ZeroAdvice(const models::ZeroSchedule& schedule,
                       const models::HeldOutErrors& errors,
                       const data::Unit& unit,
                       double goal);

/// How things stand `age` (s) and `change` (temperature's unit) after a probe,
/// in a sentence.
std::string ZeroDueText(const models::ZeroTrigger& advised,
                        const models::HeldOutErrors& errors,
                        double age,
                        double change);

}  // namespace errmap::report
