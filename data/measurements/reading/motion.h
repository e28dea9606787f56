#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace errmap::data {

/// The values that a column comes back to, as positions that a program
/// commands: exactly, or within a width far below what is between them.
struct Levels {
  std::vector<double> centers;      // ascending
  std::vector<Eigen::Index> codes;  // (rows) index into centers; -1: no number
  double width = 0.0;               // widest of them; 0: exactly the same
  bool come_alike = false;          // each about as often as the others
};

/// Those of a column (rows; NaN: no number). Of values that hardly ever come
/// again each is a level of its own.
Levels LevelsOf(std::span<const double> values);

/// How rows in order go through levels.
struct Motion {
  /// (rows) 1: towards higher positions, -1: lower, 0: nobody can tell.
  std::vector<int> directions;
  std::vector<Eigen::Index> passes;  // (rows) from 0 on
  Eigen::Index num_passes = 0;
  /// The levels come again, each about as often, in an order that repeats.
  bool is_commanded = false;
  bool both_ways = false;  // a good part of the rows in each direction
  bool is_sorted = false;  // never lower, or never higher, down to the last row
};

Motion MotionThrough(const Levels& levels);

}  // namespace errmap::data
