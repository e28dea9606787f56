#pragma once

#include <array>
#include <optional>
#include <vector>

#include "stats/eigen.h"
#include "stats/not_a_number.h"

namespace errmap::models {

/// The working plane of a machine as drawn: 0 X, 1 Y, 2 Z.
struct WorkingPlane {
  Index across = 0;
  Index up = 1;
};

/// Returns the plane of the sensitive directions. For X and Z, Z is horizontal,
/// as lathes are drawn; for all three it is X and Y. Empty if fewer than two
/// are sensitive.
std::optional<WorkingPlane> WorkingPlaneOf(
    const std::array<bool, 3>& sensitive);

/// The errors at the points in a cell of the plane; NaN if unknown.
struct PlaneCell {
  double across = stats::kNaN;  // its middle
  double up = stats::kNaN;
  Index points = 0;
  double mean_across = stats::kNaN;  // of the errors along both
  double mean_up = stats::kNaN;
  double rms = stats::kNaN;  // of their lengths in the plane
};

/// Cells with points, row by row from the bottom.
struct PlaneCells {
  double width = 0.0;  // of a cell
  double height = 0.0;
  std::vector<PlaneCell> cells;
};

/// Cuts the rectangle around `points` (m x 3) into cells of 4 points on
/// average, 3 to 12 in a row. Averages the `errors` (m x 3) by cell. Points and
/// errors have any units. Throws std::invalid_argument if the shapes do not
/// agree.
PlaneCells CellsOf(const WorkingPlane& plane,
                   const Eigen::MatrixX3d& points,
                   const Eigen::MatrixX3d& errors);

}  // namespace errmap::models
