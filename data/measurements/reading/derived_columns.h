#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// The same numbers without a copy of them; `table` must outlive it.
CsvTable Borrowed(const CsvTable& table);

/// A target that the table has under another name: "-correction_um", its values
/// with the other sign; "actual_mm-nominal_mm", a difference in the unit of
/// what is taken off; "Error [um]" of a column "Error" without a unit. Each may
/// end in a unit in brackets. Nothing where the table has the name itself, or
/// not what it is made of.
struct DerivedTarget {
  CsvColumn column;
  std::optional<std::size_t> of;  // index of the only column it is made of
};
std::optional<DerivedTarget> FindDerivedTarget(const CsvTable& table,
                                               const std::string& name);

/// The columns that `filters` and `session` name and a table lacks, where its
/// positions or labels can tell them: for files that a map is used on.
void AddDerivedColumns(const std::vector<ColumnFilter>& filters,
                       const std::string& position,
                       const std::string& session,
                       CsvTable* table);

/// Columns of which one was read where the other was commanded: they agree but
/// for a small part of their range, and the values of the second come again.
struct ReadBeside {
  std::size_t read;
  std::size_t commanded;
};
std::vector<ReadBeside> FindReadBeside(const CsvTable& table);

/// Throws OpenQuestion where the target is the difference of these columns, but
/// with the other sign or in another unit than its name states: nominal -
/// actual, or um under "[mm]".
void RequireDifference(const CsvTable& table,
                       std::size_t target,
                       const ReadBeside& positions);

}  // namespace errmap::data
