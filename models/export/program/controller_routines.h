#pragma once

#include "models/export/program/map_program.h"

namespace errmap::models {

/// Return MapProgram::read and MapProgram::move. The bounds and slopes of the
/// program's readings, and its judgement, must already be set.
Routine ReadRoutine(const MapProgram& program);
Routine MoveRoutine(const ControllerLimits& limits);

}  // namespace errmap::models
