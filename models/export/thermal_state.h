#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "data/csv.h"
#include "models/error_model.h"
#include "models/export/compensation_table.h"
#include "models/export/program/error_curve.h"

namespace errmap::models {

/// Parses "t1_degC=21,t2_degC=22". Throws std::invalid_argument naming a part
/// that is not NAME=VALUE.
std::vector<HeldReading> ParseHeldReadings(std::string_view text);

/// Throws std::invalid_argument unless each of `held` is read by at least one
/// of the maps, other than as its position.
void RequireHeldReadings(const std::vector<HeldReading>& held,
                         const std::vector<const MapProgram*>& programs);

/// Returns the map in the state after `row` of a log's session (from 0, below
/// log.num_rows). `log` has the map's names and units.
ErrorCurve CurveAfterLog(const FittedModel& fitted,
                         const MapProgram& program,
                         const data::CsvTable& log,
                         int row);

/// Returns "at t1_degC = 21, t2_degC = 22": all readings but the position.
std::string StateText(const ErrorCurve& curve);

/// Parses a grid such as "33x9" across the reading `over`. It may be "" if at
/// most one reading exists besides the position. Throws std::invalid_argument
/// if the text is not a grid, or `over` is not a reading.
GridOptions ParseGrid(const std::string& grid,
                      const std::string& over,
                      const ErrorCurve& curve);

}  // namespace errmap::models
