#pragma once

#include "models/error_model.h"
#include "models/history/map_log.h"
#include "models/history/point_log.h"
#include "models/session/map_rows.h"
#include "models/session/session_offset.h"
#include "stats/eigen.h"

namespace errmap::models {

/// What probes of a session say of the rows that a map predicts.
struct ProbeCorrection {
  Index num_probes = 0;
  OffsetModel model;
  OffsetTrack track;  // of the rows; its offset is to be added, target's unit
};

/// How the probes' own rows are to be made: without a target they are readings
/// between probes, and a memory runs through the rows that are predicted, too,
/// unless `log` has rows before all of them.
MapRowsOptions ProbeRowsOptions(const FittedModel& fitted,
                                const MapDataArguments& log);

/// For the rows of `today`, each by the probes of its session up to its time;
/// `probes` are rows made with ProbeRowsOptions. Throws data::InputError where
/// the tables will not do (MakePointLog).
ProbeCorrection CorrectByProbes(const FittedModel& fitted,
                                const MapRows& probes,
                                const RowsForMap& today,
                                const MapDataArguments& log);

}  // namespace errmap::models
