#pragma once

#include "models/error_model.h"
#include "models/history/map_log.h"
#include "models/history/point_log.h"
#include "models/session/map_rows.h"
#include "models/session/session_offset.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Corrections from the probes of a session to the rows that a map predicts.
struct ProbeCorrection {
  Index num_probes = 0;
  OffsetModel model;
  OffsetTrack track;  // of the rows; its offset is to be added, target's unit
};

/// Returns the options for the rows of the probes. Rows without a target are
/// readings between probes. Filters also run through the predicted rows, unless
/// `log` has earlier rows.
MapRowsOptions ProbeRowsOptions(const FittedModel& fitted,
                                const MapDataArguments& log);

/// Returns the corrections of the rows of `today`, each from the probes of its
/// session up to its time. `probes` are rows made with ProbeRowsOptions. Throws
/// data::InputError if the tables are unusable (MakePointLog).
ProbeCorrection CorrectByProbes(const FittedModel& fitted,
                                const MapRows& probes,
                                const RowsForMap& today,
                                const MapDataArguments& log);

}  // namespace errmap::models
