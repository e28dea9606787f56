#pragma once

#include "models/export/program/map_program.h"

namespace errmap::models {

/// No reading and no error is as large; a real number in single precision too,
/// in which some compilers of structured text fold their constants.
inline constexpr double kHuge = 1e30;

/// MapProgram::read and MapProgram::move, of a program whose readings have
/// their bounds and slopes, and whose judgement is known.
Routine ReadRoutine(const MapProgram& program);
Routine MoveRoutine(const ControllerLimits& limits);

}  // namespace errmap::models
