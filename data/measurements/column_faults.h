#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "data/units.h"

namespace errmap::data {

struct ColumnInfo;

enum class FaultKind {
  kImpossible,  // a temperature that no thermometer of a machine shows
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

/// What is wrong with a column; all values in the column's unit.
struct ColumnFault {
  FaultKind kind = FaultKind::kOutlying;
  Eigen::Index input = -1;  // index of the column among the inputs; -1: target
  /// Data rows of the file concerned, ascending. Of kNoisy and kDrifting none.
  std::vector<Eigen::Index> rows;
  /// Single cells are wrong, so that their rows can be left out; otherwise the
  /// column as a whole is not to be trusted.
  bool of_cells = false;
  /// The first row's value; of kStep the height; of kNoisy the standard
  /// deviation of the noise; of kDrifting the change from first to last row; of
  /// kOtherUnit how many times larger the others are.
  double value = 0.0;
  /// What to hold it against: the range of all other values (kImpossible,
  /// kOutlying), the neighbours (kJump, both the same), the change of the
  /// others meanwhile (kStuck: low 0, high their median range), their noise
  /// (kNoisy, likewise), the scatter about the drift (kDrifting; low is the
  /// number of others); of kZero low is what a linear map makes of the worst.
  double low = 0.0;
  double high = 0.0;
};

/// Data rows with single cells that are wrong, ascending, each once.
std::vector<Eigen::Index> RowsOfCellFaults(
    const std::vector<ColumnFault>& faults);

/// Columns of measurements, (m) rows in the order in which they were measured.
struct MeasuredColumns {
  const ColumnInfo& target;
  const Eigen::VectorXd& target_values;   // (m)
  const std::vector<ColumnInfo>& inputs;  // (p)
  const Eigen::MatrixXd& input_values;    // (m x p)
  const std::vector<Eigen::Index>& rows;  // (m) data row in the file
  Eigen::Index num_sessions = 0;          // 0: not known
};

/// One sentence where rows like these change what every figure of a study
/// means, and what leaves them out; "" otherwise.
std::string DoubtOfRows(const ColumnFault& fault,
                        const MeasuredColumns& measured);

/// Looks through target and inputs for readings that no machine made.
/// Thresholds are set so that healthy machines give none; the test of this unit
/// has the measurements. Drift is looked for over three sessions or more.
std::vector<ColumnFault> FindColumnFaults(const MeasuredColumns& measured);

}  // namespace errmap::data
