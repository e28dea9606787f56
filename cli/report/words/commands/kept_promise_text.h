#pragma once

#include <string>

#include <Eigen/Core>

#include "cli/report/number_text.h"
#include "data/units.h"
#include "models/sensors/applicability.h"
#include "models/sensors/sensitivity.h"
#include "models/session/kept_promise.h"
#include "models/session/probe_correction.h"
#include "models/uncertainty/map_update.h"

namespace errmap::report {

// What is said of a map on rows that it has not seen, and of readings that go
// wrong; `unit` is its target's.

/// What it erred by on so many rows beside what was promised, no map at all,
/// and an offset; of the last nothing where rows are too few.
std::string KeptPromiseText(const models::KeptPromise& kept,
                            Eigen::Index rows,
                            const data::Unit& unit);

/// The sensor that reads something else than the others tell.
std::string RelationText(const models::RelationChange& change);

/// RMSE of the old and the new map by session, as a table. `all_unseen`: the
/// old map has seen none of them.
std::string TrialText(const models::UpdateTrial& trial,
                      const data::Unit& unit,
                      bool all_unseen);

/// How far probes move the predictions, and how surely; one line without end.
std::string OffsetLine(const models::ProbeCorrection& correction,
                       const data::Unit& unit);

/// What noise, a failing thermometer and a new zero do to the predictions; one
/// line without end, "" where no input is a temperature.
std::string SensitivityLine(const models::Sensitivity& sensitivity,
                            const ErrorText& error);

}  // namespace errmap::report
