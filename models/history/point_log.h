#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "models/history/history.h"
#include "models/history/map_log.h"

namespace errmap::models {

/// A table and what a map reads in its rows; NaN where it is not known.
struct RowsForMap {
  const data::CsvTable& table;
  const Eigen::MatrixXd& inputs;  // (rows x inputs of the map)
};

/// What the filters of a map run through where points lie between the rows of
/// a log: both, session by session, in order of time, the log first where both
/// have the same time.
struct PointLog {
  std::shared_ptr<const data::SessionLog> log;
  std::vector<Eigen::Index> rows;  // (points) in the log
  std::vector<Missing> missing;    // (points)
};

/// `log` may be null. Sessions of the log without a point are left out. The
/// zero is taken where the session begins. Throws data::InputError as
/// FindSessionsFor.
PointLog MakePointLog(const History& history,
                      const RowsForMap& points,
                      const RowsForMap* log,
                      const MapLogArguments& arguments);

}  // namespace errmap::models
