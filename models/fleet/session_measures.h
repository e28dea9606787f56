#pragma once

#include <string>
#include <vector>

#include "models/error_model.h"
#include "models/fleet/watch.h"
#include "models/session/map_rows.h"
#include "stats/eigen.h"

namespace errmap::models {

/// A session and the rows of the data set that belong to it, in their order.
struct MeasuredSession {
  WatchedSession session;
  std::vector<Index> rows;
};

/// Returns why new sessions cannot be compared with the map's promise; "" if
/// they can. That needs the map's errors in at least three held-out sessions.
std::string WhyNotWatched(const FittedModel& fitted);

/// Returns the map's results in each session of `rows`. `relations` (null:
/// unknown) describe the sensors; they are used if the table has all of them.
std::vector<MeasuredSession> MeasureSessions(const FittedModel& fitted,
                                             const MapRows& rows,
                                             const SensorRelations* relations);

}  // namespace errmap::models
