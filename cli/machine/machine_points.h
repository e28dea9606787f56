#pragma once

#include <string>
#include <vector>

#include "data/csv.h"
#include "models/history/map_log.h"
#include "models/kinematics/machine.h"
#include "models/kinematics/volumetric.h"
#include "stats/eigen.h"

namespace errmap::machine {

/// Predictions of a machine's maps at the points of a table.
struct MachinePoints {
  MatrixXd coordinates;  // (m x coordinates) the chain's units
  std::vector<models::ComponentAtPoints> components;  // as machine.errors
  /// (components)(m) True if a map extrapolates there: an input is outside its
  /// trained range, or the first rows of the session are missing.
  std::vector<std::vector<bool>> outside;
  std::vector<std::string> remarks;  // one line each
};

/// Evaluates every map at every point. A map's position is the coordinate of
/// its link. Its other inputs are columns of the points by name, converted to
/// its units. DirectionColumn chooses the map of a pair. Filters run through
/// the rows of `log` (may be null) and the points together, in order of time,
/// session by session. Half-widths are for 90 %, from Student's t of the errors
/// on held-out units, or else from the interval in the model file. Throws
/// data::InputError, naming file, error and column, if a column is missing, has
/// a unit of another quantity, or holds values other than numbers or
/// directions.
MachinePoints EvaluateAt(const models::Machine& machine,
                         const data::CsvTable& points,
                         const data::CsvTable* log,
                         const models::MapDataArguments& arguments);

}  // namespace errmap::machine
