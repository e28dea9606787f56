#pragma once

#include <string>

#include "data/units.h"
#include "models/export/program/error_curve.h"

namespace errmap::models {

/// LinuxCNC holds no more points of a joint than this.
inline constexpr int kMostCompPoints = 256;

struct CompFileOptions {
  data::Unit unit;  // of the machine: [TRAJ] LINEAR_UNITS
  int most_points = kMostCompPoints;
  /// Steps in which errors are written (machine unit); 0: as they are.
  double resolution = 0.0;
};

struct CompFile {
  std::string text;
  int num_points = 0;
  double low = 0.0;  // ends of the table, machine unit
  double high = 0.0;
  double interpolation_error = 0.0;  // machine unit
  /// The largest difference between map and table with its steps; the same as
  /// above without a resolution.
  double error_with_steps = 0.0;
  AtLimit forward_at_limit = {};  // machine unit
  AtLimit reverse_at_limit = {};
};

/// A COMP_FILE of type 0 for LinuxCNC: `nominal forward reverse` per line, no
/// header and no comment (a `#` would end it), ascending. LinuxCNC moves the
/// motor by nominal - column, and its forward column holds where the position
/// increases: forward = nominal + error of `increasing`, reverse = nominal +
/// error of `decreasing`, each within the limit of its map. Over the range that
/// both were trained in. Throws std::invalid_argument where there is none, or
/// an error or position is no length.
CompFile LinuxcncCompFile(const ErrorCurve& increasing,
                          const ErrorCurve& decreasing,
                          const CompFileOptions& options);

struct GridOptions {
  int over = -1;  // reading across the columns; -1: positions alone
  int positions = 33;
  int columns = 9;
};

struct GridTable {
  std::string text;
  double interpolation_error = 0.0;  // bilinear, target's unit
  int num_cells = 0;
  AtLimit at_limit = {};  // cells; the position's own unit
};

/// CSV of the compensation, -error, at positions (rows) and values of a
/// reading (columns, named NAME=VALUE), both even over their trained range, and
/// within the limit of the map. A line that begins with # says sign, unit and
/// limit.
GridTable CompensationGrid(const ErrorCurve& curve, const GridOptions& options);

}  // namespace errmap::models
