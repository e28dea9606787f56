#pragma once

#include <string>
#include <vector>

#include "models/error_model.h"
#include "models/fleet/watch.h"
#include "models/session/map_rows.h"
#include "stats/eigen.h"

namespace errmap::models {

/// A session and which rows of the data set are its own, in their order.
struct MeasuredSession {
  WatchedSession session;
  std::vector<Index> rows;
};

/// Why new sessions cannot be held against what the map promises; "" where they
/// can: its errors in three sessions or more that it never saw are known.
std::string WhyNotWatched(const FittedModel& fitted);

/// Each session of `rows` as the map does in it. `relations` (null: not known)
/// tell of the sensors where the table has all of them.
std::vector<MeasuredSession> MeasureSessions(const FittedModel& fitted,
                                             const MapRows& rows,
                                             const SensorRelations* relations);

}  // namespace errmap::models
