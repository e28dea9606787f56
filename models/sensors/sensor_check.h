#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "stats/eigen.h"

namespace errmap::models {

/// The fault of a sensor that a map reads.
enum class SensorFault {
  kUnit,     // its values suit another unit
  kDead,     // one impossible reading throughout, or none at all
  kFrozen,   // one reading for longer than ever in training
  kSwapped,  // two sensors are exchanged
  kOff,      // it contradicts all others
  kSpike,    // single impossible readings
};
/// "unit", "dead", "frozen", "swapped", "off", "spike".
std::string_view ToString(SensorFault fault);

struct SensorFaultFound {
  SensorFault fault = SensorFault::kOff;
  std::vector<data::ColumnInfo> columns;  // one; for kSwapped two
  /// For kOff: reading minus expected reading; kDead, kFrozen and kSpike: its
  /// reading (NaN: none). In the column's unit.
  double value = 0.0;
  Index row = -1;               // for kSpike: the first row
  std::string looks_like = {};  // for kUnit: "K"
};

/// Returns the faulty sensor of a session, if there is one. `readings` (n x
/// inputs of the map, their units; n at least 1) are in order of time, NaN for
/// empty cells.
///
/// For kOff and kSwapped, the likelihood of all readings is compared with and
/// without the fault. If all sensors differ from training, the thermal state is
/// new and no sensor is at fault. Rows with a spike are excluded; spikes are
/// reported if nothing else is wrong.
std::optional<SensorFaultFound> FindSensorFault(const FittedModel& fitted,
                                                const MatrixXd& readings);

}  // namespace errmap::models
