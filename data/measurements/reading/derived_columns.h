#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// Refers to the same numbers without a copy; `table` must outlive it.
CsvTable Borrowed(const CsvTable& table);

/// A target that is derived from columns of the table. "-correction_um": its
/// values with the other sign. "actual_mm-nominal_mm": a difference in the unit
/// of the subtracted column. "Error [um]": a column "Error" without a unit.
/// Each may end in a unit in brackets. There is none if the table has a column
/// of that name, or lacks the columns needed.
struct DerivedTarget {
  CsvColumn column;
  std::optional<std::size_t> of = {};  // index of the only column it is made of
};
std::optional<DerivedTarget> FindDerivedTarget(const CsvTable& table,
                                               const std::string& name);

/// Adds columns that `filters` and `session` name and a table lacks, if they
/// follow from its positions or labels. For files to which a map is applied.
void AddDerivedColumns(const std::vector<ColumnFilter>& filters,
                       const std::string& position,
                       const std::string& session,
                       CsvTable* table);

/// A measured and a commanded column. They agree except for a small part of
/// their range, and the values of the commanded one recur.
struct ReadBeside {
  std::size_t read;
  std::size_t commanded;
};
std::vector<ReadBeside> FindReadBeside(const CsvTable& table);
/// True if the values agree except for a small part of their range.
bool IsReadOf(const CsvColumn& read, const CsvColumn& commanded);

/// Throws OpenQuestion if the target is the difference of these columns, but
/// with the other sign or in another unit than its name states: nominal -
/// actual, or um under "[mm]".
void RequireDifference(const CsvTable& table,
                       std::size_t target,
                       const ReadBeside& positions);

/// Name of a column of sessions that is derived from another column's labels.
std::string SessionsNamedIn(std::string_view labels);

/// Returns the sessions named in labels of cycles, which also have a number
/// that starts again in each session: "D1" of "D1C1", "X_20240304" of
/// "X_20240304_01.rtl", "1" of 1.1 or 101. Each session has two cycles or more.
/// It is "" outside `rows`, which are in the order of measurement. Returns
/// nothing if the labels give fewer than `least` sessions.
std::optional<CsvColumn> FindSessionsInLabels(
    const CsvTable& table,
    const CsvColumn& labels,
    const std::vector<Eigen::Index>& rows,
    std::size_t least = 2);

}  // namespace errmap::data
