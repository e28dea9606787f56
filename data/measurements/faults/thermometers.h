#pragma once

#include <optional>
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

struct CellFaults {
  std::vector<ColumnFault> faults;  // rows from 0
  /// Temperature inputs for comparison with other columns, without their
  /// faults.
  std::vector<Thermometer> thermometers;
};

/// Finds single values that stand out (kImpossible, kOutlying). Then, for
/// thermometers, finds values that differ from their neighbours (kJump).
CellFaults FindCellFaults(const MeasuredColumns& measured);

/// Temperatures expected in a shop; thermometers outside this range are
/// examined.
inline constexpr double kColdest = -50.0;  // degC
inline constexpr double kHottest = 200.0;  // degC

/// True if temperatures outside the limits of a shop (`wrong`, rows from 0, not
/// empty) are plausible. The column must change slowly, without a gap between
/// these and its other values. No other unit may bring it closer to its
/// neighbours, or to a shop if it has none. If all its neighbours are within
/// the limits, it must also change, since an open input is noise about one
/// value.
bool AreBelieved(const MeasuredColumns& measured,
                 Eigen::Index input,
                 const std::vector<Eigen::Index>& wrong);

/// Compares thermometers with the others. Finds those that step while no other
/// moves (kStep), those that stay constant while the others change (kStuck),
/// and noisy ones. Rows count from 0.
std::vector<ColumnFault> FindThermometerFaults(
    const MeasuredColumns& measured,
    const std::vector<Thermometer>& thermometers);

/// Finds thermometers that depart further from the others in each session
/// (kDrifting), the worst first. Skips columns that are faulty as a whole
/// according to `known`.
std::vector<ColumnFault> FindDrift(const MeasuredColumns& measured,
                                   const std::vector<Thermometer>& thermometers,
                                   const std::vector<ColumnFault>& known);

/// Finds the thermometer that departs further from the mean of the others at
/// the start (rows from 0) of each session. It finds those too different for
/// FindDrift, and needs four sessions or more.
std::optional<ColumnFault> FindColdDrift(
    const MeasuredColumns& measured,
    const std::vector<Eigen::Index>& session_starts,
    const std::vector<ColumnFault>& known);

}  // namespace errmap::data
