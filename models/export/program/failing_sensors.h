#pragma once

#include <string>
#include <vector>

#include "models/export/program/map_program.h"

namespace errmap::models {

/// Largest effect of a failed sensor on the error given, once every filter has
/// settled; target's unit. Before it, positions and sensors are at the ends or
/// in the middle of their trained range: what MeasureSensitivity
/// (models/sensors/sensitivity.h) finds over the rows of training.
struct FailingSensor {
  std::string name;
  double zero = 0.0;     // it reads 0, without any checks
  double without = 0.0;  // it reads anything, without any checks
  /// It reads anything, with checks and limits. It includes the loss of the
  /// compensation if the reading is not trusted.
  double with = 0.0;
};

/// Returns all sensors, sorted by falling `zero`. `program` has its controller.
std::vector<FailingSensor> WorstOfFailing(const MapProgram& program);

}  // namespace errmap::models
