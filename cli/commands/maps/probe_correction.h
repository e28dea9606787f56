#pragma once

#include <string>

#include <Eigen/Core>

#include "cli/study_file/memory/map_log.h"
#include "cli/study_file/memory/point_log.h"
#include "models/error_model.h"

namespace errmap::cli {

/// What probes of a session say of the rows that a map predicts.
struct ProbeCorrection {
  Eigen::VectorXd offset;     // (rows) to be added, target's unit
  Eigen::VectorXd narrowing;  // (rows) of intervals: at most 1
  std::string line;           // for people
};

/// Of the probes of a file, for the rows of `today`; each is corrected by the
/// probes of its session up to its time. A memory runs through the rows of
/// `today` between the probes. Throws data::InputError where the map holds no
/// held-out errors, or as ReadMapRows does.
ProbeCorrection CorrectByProbes(const models::FittedModel& fitted,
                                const std::string& probes,
                                const RowsForMap& today,
                                const MapLogArguments& log,
                                bool quiet);

}  // namespace errmap::cli
