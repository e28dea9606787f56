#pragma once

#include <string>

#include <Eigen/Core>

#include "cli/report/number_text.h"
#include "data/units.h"
#include "models/sensors/sensitivity.h"
#include "models/session/kept_promise.h"
#include "models/session/probe_correction.h"
#include "models/uncertainty/map_update.h"

namespace errmap::report {

// What is said of a map on rows that it has not seen, and of readings that go
// wrong; `unit` is its target's.

/// What it erred by beside what was promised; "" where nothing was.
std::string FoundText(const models::KeptPromise& kept, const data::Unit& unit);

/// The same on so many rows, beside no map at all and an offset, too; of the
/// last nothing where rows are too few.
std::string KeptPromiseText(const models::KeptPromise& kept,
                            Eigen::Index rows,
                            const data::Unit& unit);

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
