#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/column_faults.h"

namespace errmap::data {

// What the searches for faults of columns share.

/// Fewest rows needed to examine a column.
inline constexpr Eigen::Index kFewestRows = 12;

/// Thresholds of jumps and steps, in multiples of the column's noise.
inline constexpr double kJumpNoise = 20.0;

/// Fewest other thermometers for a comparison.
inline constexpr std::size_t kFewestOthers = 3;

/// A temperature column without its faulty cells.
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

/// Makes a fault of `rows` (from 0). If they are few, and its kind allows it,
/// it is a fault of single cells.
ColumnFault MakeFault(const MeasuredColumns& measured,
                      FaultKind kind,
                      Eigen::Index input,
                      std::vector<Eigen::Index> rows,
                      double value,
                      Bounds held);

/// Largest number of faulty cells that count as single ones.
Eigen::Index MostCells(Eigen::Index num_rows);

/// Rows (from 0) without a faulty cell of these thermometers.
std::vector<Eigen::Index> SoundRows(const MeasuredColumns& measured,
                                    std::span<const Thermometer> thermometers);

/// The input's values in those rows.
std::vector<double> ValuesAt(const MeasuredColumns& measured,
                             const std::vector<Eigen::Index>& rows,
                             Eigen::Index input);

/// The upper median; NaN if there are no values.
double MedianOf(std::vector<double> values);

}  // namespace errmap::data
