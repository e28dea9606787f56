#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace errmap::data {

/// Values to which a column returns, like commanded positions: exactly, or
/// within a tolerance far below their spacing.
struct Levels {
  std::vector<double> centers;      // ascending
  std::vector<Eigen::Index> codes;  // (rows) index into centers; -1: no number
  double width = 0.0;               // of the widest; 0: exactly the same values
  bool come_alike = false;          // each occurs about equally often
};

/// Returns the levels of a column (rows; NaN: no number). If values hardly ever
/// return, each is a level.
Levels LevelsOf(std::span<const double> values);

/// Divides the range into equal parts in place of levels, for a position read
/// during motion. A reading that hovers between two parts stays in one.
Levels PartsOfRange(std::span<const double> values);

/// Path of successive rows through the levels.
struct Motion {
  /// (rows) 1: towards higher positions, -1: lower, 0: unknown.
  std::vector<int> directions;
  std::vector<Eigen::Index> passes;  // (rows) from 0 on
  Eigen::Index num_passes = 0;
  /// The levels return about equally often, in an order that repeats.
  bool is_commanded = false;
  bool both_ways = false;  // many rows in each direction
  bool is_sorted = false;  // never falls, or never rises
};

Motion MotionThrough(const Levels& levels);

}  // namespace errmap::data
