#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/column_faults.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// Returns a remark if the target's size is implausible for a machine. Errors
/// of millimetres, or too small to be measured, suggest a wrong unit.
std::optional<std::string> UnlikelySize(const ColumnInfo& target,
                                        const Eigen::VectorXd& values);

/// Returns a remark on thermometers without a unit whose readings are those of
/// a shop and a warm machine in degF.
std::optional<std::string> LikelyFahrenheit(
    const std::vector<ColumnInfo>& inputs, const Eigen::MatrixXd& values);

/// Returns a remark if positions or temperatures of one session would be like
/// those of the one beside it in another unit. `starts`: the first row of each.
std::optional<std::string> OtherUnitInSession(
    const ColumnInfo& input,
    const Eigen::Ref<const Eigen::VectorXd>& values,
    const std::vector<Eigen::Index>& starts);

/// Throws OpenQuestion if the target's unit is not stated, and the values (RMS
/// above 1), or columns in inches and degF, contradict the assumed mm. Also
/// throws if no unit can be assumed ("Abweichung") and the target was not
/// `named`.
void AskForUnit(const CsvTable& table,
                const std::string& target,
                const Eigen::VectorXd& values,
                bool named);

/// Returns the weights of these rows, scaled to mean 1, since only their ratios
/// matter. Equal weights count as no weights. Throws InputError if one is not
/// above 0, or less than 1e-30 of the largest.
Eigen::VectorXd WeightsOf(const CsvTable& table,
                          const CsvColumn& column,
                          const std::vector<Eigen::Index>& rows);

/// Throws InputError if the sum of squares of `values` overflows, since every
/// statistic needs it. `what` is "target" or "input"; the input is `column`, in
/// these `rows` of the table.
void RequireSquares(const CsvTable& table,
                    const std::vector<Eigen::Index>& rows,
                    const std::string& what,
                    const std::string& column,
                    const Eigen::Ref<const Eigen::VectorXd>& values);

/// A remark on a column of words.
struct PartingRemark {
  std::string text;
  bool is_doubt = false;  // its rows err differently
};

/// Tests whether columns of words (indices into the table) divide the rows into
/// parts with different errors, such as machines, tools and directions. It
/// compares linear maps of all rows with those of each value. The columns have
/// 2 to 12 values that change within one of `sessions` (a code for each row;
/// empty: one). Columns that pass PartsComponents always get a remark, switches
/// (of the inputs, by their role) only if one state's errors are far larger.
std::vector<PartingRemark> FindParts(const CsvTable& table,
                                     const std::vector<std::size_t>& words,
                                     const Dataset::Parts& parts,
                                     const std::vector<Eigen::Index>& sessions);

/// An input that would harm a map.
struct UselessInput {
  Eigen::Index input;
  std::string why;          // "is dead (stuck at 85 from data row 12 on)"
  std::string behind;       // what is said after it
  bool even_named = false;  // left out though somebody asked for it
};

/// Finds components of the error itself, which no control knows beforehand:
/// inputs that together determine the target, by least squares on the rows.
/// Examples are the measured next to the nominal position, or a copy in another
/// unit or in ppm of the position. Others are two halves, the size of the
/// error, or whether it exceeds a limit. Encoder counts are recognised by the
/// axis. Temperatures, times, and positions alone are states of a machine,
/// never parts of its error: a target that is a plain function of them has a
/// good map. Positions or a few settings in such a set are kept.
std::vector<UselessInput> LeakingInputs(const Dataset::Parts& parts);

/// Finds inputs that number the cycles through all sessions (a code for each
/// row), in whatever steps. Also finds those that never fall from the first row
/// to the last (hours, kilometres, energy). These are not thermal states. A
/// count that restarts with each session, such as hours since the start, may be
/// one.
std::vector<UselessInput> CountingInputs(
    const Dataset::Parts& parts, const std::vector<Eigen::Index>& sessions);

/// Finds thermometers that stop changing for the rest of the data.
std::vector<UselessInput> StuckInputs(const Dataset::Parts& parts,
                                      std::span<const ColumnFault> faults);

}  // namespace errmap::data
