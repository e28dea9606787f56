#pragma once

#include <string>

#include <Eigen/Core>

#include "cli/report/number_text.h"
#include "data/units.h"
#include "models/sensors/sensitivity.h"
#include "models/session/calibration_check.h"
#include "models/session/probe_correction.h"
#include "models/uncertainty/map_update.h"

namespace errmap::report {

// What is said of a map on rows that it has not seen, and of readings that go
// wrong; `unit` is its target's.

/// Compares a map's error with the promised one;
std::string FoundText(const models::CalibrationCheck& kept,
                      const data::Unit& unit);

/// Makes the same comparison on this many rows, and with no map and an offset
/// alone. The offset is left out if there are too few rows.
std::string KeptPromiseText(const models::CalibrationCheck& kept,
                            Eigen::Index rows,
                            const data::Unit& unit);

/// Returns a table of the RMSE of the old and the new map by session.
/// `all_unseen`: the old map was fitted to none of them.
std::string TrialText(const models::UpdateTrial& trial,
                      const data::Unit& unit,
                      bool all_unseen);

/// Returns how far probes shift the predictions, and how certain that is; one
/// line without a line feed.
std::string OffsetLine(const models::ProbeCorrection& correction,
                       const data::Unit& unit);

/// Returns how noise, a failing thermometer and a new zero change the
/// predictions; one line without a line feed. "" if no input is a temperature.
std::string SensitivityLine(const models::Sensitivity& sensitivity,
                            const ErrorText& error);

}  // namespace errmap::report
