#pragma once

#include "models/export/program/map_program.h"

namespace errmap::models {

/// MapProgram::read and MapProgram::move, of a program whose readings have
/// their bounds and slopes, and whose judgement is known.
Routine ReadRoutine(const MapProgram& program);
Routine MoveRoutine(const ControllerLimits& limits);

}  // namespace errmap::models
