#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "data/csv.h"
#include "data/units.h"
#include "models/error_model.h"
#include "models/export/program/error_curve.h"

namespace errmap::models {

/// Largest number of points that LinuxCNC accepts for a joint.
inline constexpr int kMostCompPoints = 256;

struct CompFileOptions {
  data::Unit unit;  // of the machine: [TRAJ] LINEAR_UNITS
  int most_points = kMostCompPoints;
  /// Resolution of the written errors (machine unit); 0: not rounded.
  double resolution = 0.0;
};

struct CompFile {
  std::string text;
  int num_points = 0;
  double low = 0.0;  // first point of the table, machine unit
  double high = 0.0;
  double interpolation_error = 0.0;  // machine unit
  /// Largest difference between the map and the rounded table; equal to
  /// interpolation_error without a resolution.
  double error_with_steps = 0.0;
  AtLimit forward_at_limit = {};  // machine unit
  AtLimit reverse_at_limit = {};
};

/// A COMP_FILE of type 0 for LinuxCNC: ascending lines `nominal forward
/// reverse`, without header or comment (a `#` would end it). LinuxCNC moves the
/// motor by nominal - column, and uses the forward column while the position
/// increases. So forward = nominal + error of `increasing`, and reverse =
/// nominal + error of `decreasing`, each within its map's limit. It covers the
/// range in which both were trained. Throws std::invalid_argument if there is
/// none, or if an error or position is not a length.
CompFile LinuxcncCompFile(const ErrorCurve& increasing,
                          const ErrorCurve& decreasing,
                          const CompFileOptions& options);

struct GridOptions {
  int over = -1;  // reading across the columns; -1: none
  int positions = 33;
  int columns = 9;
};

struct GridTable {
  std::string text;
  double interpolation_error = 0.0;  // bilinear, target's unit
  int num_cells = 0;
  AtLimit at_limit = {};  // cells; the position's own unit
};

/// Returns the compensation, -error, as CSV, within the map's limit. Rows are
/// positions, columns are values of a reading (named NAME=VALUE), both evenly
/// spaced over their trained range. A first line that begins with # states
/// sign, unit and limit.
GridTable CompensationGrid(const ErrorCurve& curve, const GridOptions& options);

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
