#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "data/csv.h"
#include "models/error_model.h"
#include "models/export/compensation_table.h"
#include "models/export/program/error_curve.h"

namespace errmap::models {

/// "t1_degC=21,t2_degC=22". Throws std::invalid_argument naming what is no
/// NAME=VALUE.
std::vector<HeldReading> ParseHeldReadings(std::string_view text);

/// Throws std::invalid_argument unless every one of `held` is read by some of
/// the maps, beside their position.
void RequireHeldReadings(const std::vector<HeldReading>& held,
                         const std::vector<const MapProgram*>& programs);

/// The map in the state that the session of a log leads to at `row` (from 0,
/// below log.num_rows); `log` has the map's names and units.
ErrorCurve CurveAfterLog(const FittedModel& fitted,
                         const MapProgram& program,
                         const data::CsvTable& log,
                         int row);

/// "at t1_degC = 21, t2_degC = 22": all but the position.
std::string StateText(const ErrorCurve& curve);

/// The grid of "33x9" across the reading `over`, which may be "" where there is
/// one beside the position, or none. Throws std::invalid_argument where the
/// text is no grid, or the reading is none.
GridOptions ParseGrid(const std::string& grid,
                      const std::string& over,
                      const ErrorCurve& curve);

}  // namespace errmap::models
