#pragma once

#include <memory>
#include <vector>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "models/history/history.h"
#include "models/history/map_log.h"
#include "stats/eigen.h"

namespace errmap::models {

/// A table and a map's inputs in its rows; NaN if unknown.
struct RowsForMap {
  const data::CsvTable& table;
  const MatrixXd& inputs;  // (rows x inputs of the map)
};

/// Merges points and the rows of a log for the filters of a map, session by
/// session, in time order. At equal times the log comes first.
struct PointLog {
  std::shared_ptr<const data::SessionLog> log;
  std::vector<Index> rows;       // (points) index in the log
  std::vector<Missing> missing;  // (points)
};

/// `log` may be null. Sessions of the log without points are omitted. The zero
/// is taken where the session begins. Throws data::InputError like
/// FindSessionsFor.
PointLog MakePointLog(const History& history,
                      const RowsForMap& points,
                      const RowsForMap* log,
                      const MapDataArguments& arguments);

}  // namespace errmap::models
