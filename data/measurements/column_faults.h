#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "data/units.h"

namespace errmap::data {

struct ColumnInfo;

enum class FaultKind {
  kImpossible,  // a temperature that no machine reaches
  kOutlying,    // far beyond all other values, such as the code 9999
  kJump,        // a temperature that leaves its neighbours for 1 to 3 rows
  kStep,        // a temperature that steps where no other moves
  kStuck,       // one temperature for long while the others change
  kNoisy,       // a thermometer with far more noise than the others
  kDrifting,    // a thermometer that leaves the others, more from day to day
  kRepeated,    // a row that repeats another value for value
  kZero,        // a target of 0 where the others say that there is an error
  kOtherUnit,   // targets hundreds of times smaller than all others
};

/// "impossible", "outlying", "jump", "step", "stuck", "noisy", "drifting",
/// "repeated", "zero", "other-unit".
std::string_view ToString(FaultKind kind);

/// A fault of a column; all values are in the column's unit.
struct ColumnFault {
  FaultKind kind = FaultKind::kOutlying;
  Eigen::Index input = -1;  // index of the column among the inputs; -1: target
  /// Data rows of the file concerned, ascending; none for kNoisy and kDrifting.
  std::vector<Eigen::Index> rows;
  /// True: single cells are wrong, and their rows can be left out. False: the
  /// whole column cannot be trusted.
  bool of_cells = false;
  /// The first row's value. For kStep: the height; kNoisy: the noise's standard
  /// deviation; kDrifting: the change from first to last row; kOtherUnit: the
  /// factor by which the others are larger.
  double value = 0.0;
  /// Reference for comparison. For kImpossible and kOutlying: the range of all
  /// other values. kJump: the neighbours (both the same). kStuck: low 0, high
  /// the median range of the others in these rows. kNoisy: the same for their
  /// noise. kDrifting: high the scatter about the drift, low the number of
  /// others. kZero: low the prediction of a linear map for the worst row.
  double low = 0.0;
  double high = 0.0;
};

/// Returns the data rows with wrong single cells, ascending, each once.
std::vector<Eigen::Index> RowsOfCellFaults(
    const std::vector<ColumnFault>& faults);

/// Columns of measurements: (m) rows in order of measurement.
struct MeasuredColumns {
  const ColumnInfo& target;
  const Eigen::VectorXd& target_values;   // (m)
  const std::vector<ColumnInfo>& inputs;  // (p)
  const Eigen::MatrixXd& input_values;    // (m x p)
  const std::vector<Eigen::Index>& rows;  // (m) data row in the file
  Eigen::Index num_sessions = 0;          // 0: not known
};

/// If such rows affect every figure of a study, returns a sentence with the
/// option that leaves them out; else "".
std::string DoubtOfRows(const ColumnFault& fault,
                        const MeasuredColumns& measured);

/// Searches target and inputs for faulty readings. The thresholds are chosen so
/// that healthy machines give no faults; the unit test has the measurements.
/// The search for drift needs three sessions or more.
std::vector<ColumnFault> FindColumnFaults(const MeasuredColumns& measured);

}  // namespace errmap::data
