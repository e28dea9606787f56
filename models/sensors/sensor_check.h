#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"
#include "models/error_model.h"

namespace errmap::models {

/// What is wrong with a sensor that a map reads.
enum class SensorFault {
  kUnit,     // its figures would fit in another unit
  kDead,     // one reading throughout, where it cannot be, or none at all
  kFrozen,   // one reading for longer than ever in training
  kSwapped,  // two read as each other should
  kOff,      // it stands elsewhere than all others tell
  kSpike,    // single readings that no state of the machine gives
};
/// "unit", "dead", "frozen", "swapped", "off", "spike".
std::string_view ToString(SensorFault fault);

struct SensorFaultFound {
  SensorFault fault = SensorFault::kOff;
  std::vector<data::ColumnInfo> columns;  // one, of kSwapped two
  /// Of kOff by how much it is too high, of kDead, kFrozen and kSpike what it
  /// reads (NaN: nothing); the column's unit.
  double value = 0.0;
  Eigen::Index row = -1;        // of kSpike, the first: in the readings
  std::string looks_like = {};  // of kUnit: "K"
};

/// The sensor at fault in a session, if there is one. `readings` (n x inputs of
/// the map, their units; n at least 1) are those of its rows in order of time,
/// NaN where a cell is empty.
///
/// A sensor that stands elsewhere, and two that are exchanged, are held against
/// that nothing is wrong, by how likely the readings of all sensors together
/// are. A thermal state that is unlike those of training in all sensors accuses
/// none. Rows with a spike are left out of that, and are told of where nothing
/// else is wrong.
std::optional<SensorFaultFound> FindSensorFault(
    const FittedModel& fitted, const Eigen::MatrixXd& readings);

}  // namespace errmap::models
