#pragma once

#include <vector>

#include <Eigen/Core>

#include "data/measurements/column_faults.h"

namespace errmap::data {

// What the searches for faults of columns share.

/// Rows below which a column says nothing of itself.
inline constexpr Eigen::Index kFewestRows = 12;

/// Jumps and steps, in noise of the column.
inline constexpr double kJumpNoise = 20.0;

/// Other thermometers that one is held against.
inline constexpr std::size_t kFewestOthers = 3;

/// A temperature column less the cells that were found wrong.
struct Thermometer {
  Eigen::Index input = -1;
  double degree = 1.0;              // one degC in the column's unit
  std::vector<Eigen::Index> wrong;  // rows from 0, ascending
  double noise = 0.0;               // of one reading, at least the resolution
};

struct Bounds {
  double low = 0.0;
  double high = 0.0;
};

/// A difference of 1 degC in another unit.
double DegreeIn(const Unit& unit);

/// A fault of `rows` (from 0); of single cells where its kind is of cells and
/// they are few.
ColumnFault MakeFault(const MeasuredColumns& measured,
                      FaultKind kind,
                      Eigen::Index input,
                      std::vector<Eigen::Index> rows,
                      double value,
                      Bounds held);

/// So many wrong cells are single ones.
Eigen::Index MostCells(Eigen::Index num_rows);

/// Rows (from 0) whose cell is not wrong.
std::vector<Eigen::Index> SoundRows(const MeasuredColumns& measured,
                                    const Thermometer& thermometer);

/// The input's values in those rows.
std::vector<double> ValuesAt(const MeasuredColumns& measured,
                             const std::vector<Eigen::Index>& rows,
                             Eigen::Index input);

/// The upper one of two in the middle; NaN of none.
double MedianOf(std::vector<double> values);

}  // namespace errmap::data
