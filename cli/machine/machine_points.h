#pragma once

#include <string>
#include <vector>

#include "data/csv.h"
#include "models/history/map_log.h"
#include "models/kinematics/machine.h"
#include "models/kinematics/volumetric.h"
#include "stats/eigen.h"

namespace errmap::machine {

/// What a machine's maps say at the points of a table.
struct MachinePoints {
  MatrixXd coordinates;  // (m x coordinates) the chain's units
  std::vector<models::ComponentAtPoints> components;  // as machine.errors
  /// (components)(m) Whether a map extrapolates there: an input outside its
  /// trained range, or a session whose first rows are missing.
  std::vector<std::vector<bool>> outside;
  std::vector<std::string> remarks;  // one line each
};

/// Evaluates every map at every point. A map's position is the coordinate of
/// its link, its other inputs are columns of the points by name, converted to
/// its units; of a pair the column DirectionColumn says which. Filters run
/// through the rows of `log` (may be null) and the points together, in order of
/// time, session by session. Half-widths are those of 90 %, by Student's t from
/// the errors on units held out, else the interval that stands in the model
/// file. Throws data::InputError naming file, error and column where one is
/// missing, holds no numbers, no "forward" or "reverse", or has a unit of
/// another quantity.
MachinePoints EvaluateAt(const models::Machine& machine,
                         const data::CsvTable& points,
                         const data::CsvTable* log,
                         const models::MapDataArguments& arguments);

}  // namespace errmap::machine
