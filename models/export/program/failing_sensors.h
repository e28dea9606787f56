#pragma once

#include <string>
#include <vector>

#include "models/export/program/map_program.h"

namespace errmap::models {

/// What a sensor that fails, and stays so until every filter has arrived, does
/// to the error given in the middle of what was trained; target's unit.
struct FailingSensor {
  std::string name;
  double without = 0.0;  // it reads 0, and the map is left to itself
  /// The largest of anything that it may read, checks and limits at work; to
  /// lose the compensation, since the reading is not believed, is one of these.
  double with = 0.0;
};

/// Of every sensor, the one that does most by itself first. `program` with its
/// controller.
std::vector<FailingSensor> WorstOfFailing(const MapProgram& program);

}  // namespace errmap::models
