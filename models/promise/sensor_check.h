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
  kDead,     // one reading throughout, where it cannot be
  kFrozen,   // one reading for longer than ever in training
  kSwapped,  // two read as each other should
  kOff,      // it stands elsewhere than all others tell
};
/// "unit", "dead", "frozen", "swapped", "off".
std::string_view ToString(SensorFault fault);

struct SensorFaultFound {
  SensorFault fault = SensorFault::kOff;
  std::vector<data::ColumnInfo> columns;  // one, of kSwapped two
  /// Of kOff by how much it is too high, of kDead and kFrozen what it reads;
  /// the column's unit.
  double value = 0.0;
  std::string looks_like;  // of kUnit: "K"
};

/// The sensor at fault in a session, if there is one. `readings` (n x inputs of
/// the map, their units; n at least 1) are those of its rows in order of time,
/// NaN where a cell is empty.
///
/// A sensor that stands elsewhere than the others tell is at fault only where
/// all others go together without it: in an unlike thermal state several seem
/// off. It is looked for in the later third of the rows, where sensors of
/// different places differ most, and in the first row where that is the start
/// of a session (`from_start`): a machine at rest has its sensors closest
/// together, and training says how close.
std::optional<SensorFaultFound> FindSensorFault(const FittedModel& fitted,
                                                const Eigen::MatrixXd& readings,
                                                bool from_start);

/// The two sensors that are swapped by what the probes say of it, too: with
/// them swapped back the map errs as promised, and they go with the others
/// better. `probes` are measured rows, `readings` as in FindSensorFault.
std::optional<SensorFaultFound> SwapThatExplains(
    const FittedModel& fitted,
    const data::Dataset& probes,
    const Eigen::MatrixXd& readings);

/// Whether a column that is off explains better how a first row differs from
/// the starts of training than a log that begins inside a session does.
std::optional<SensorFaultFound> OffAtStart(const FittedModel& fitted,
                                           const Eigen::VectorXd& readings);

}  // namespace errmap::models
