#pragma once

#include <cstdint>

#include "models/export/program/map_program.h"

namespace errmap::models {

/// Counted operations of one step of a program, the same on any machine.
struct ProgramCost {
  std::int64_t additions = 0;  // and subtractions
  std::int64_t multiplications = 0;
  std::int64_t divisions = 0;
  std::int64_t exponentials = 0;
  std::int64_t sines = 0;  // and cosines
  std::int64_t comparisons = 0;
  std::int64_t copies = 0;
  std::int64_t state_bytes = 0;  // doubles kept from step to step
};

/// Returns the cost of a step of a program with its controller, including
/// checks and limits. Code that runs only for some readings is counted as if it
/// always ran.
ProgramCost CostOf(const MapProgram& program);

}  // namespace errmap::models
