#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "data/column_words.h"
#include "data/csv.h"
#include "data/measurements/axis/counting.h"
#include "data/measurements/axis/motion.h"
#include "data/measurements/clock/clock.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/nights.h"
#include "data/measurements/reading/read_table.h"

namespace errmap::data {

/// A table during reading, as passed on by the steps of ReadRoles.
struct TableInReading {
  const CsvTable& given;
  const DatasetSelection& selection;
  ReadTable read = {};
  std::vector<Eigen::Index> base_rows = {};  // that filters by columns leave
  Clock clock = {};                          // of those
  Nights nights = {};
  std::ptrdiff_t cycles_in_sessions = -1;  // of columns that nest
  bool ordered = true;  // whether the rows stand in the order of time

  const CsvTable& table() const { return read.table; }
  /// Replaces a column, or appends one.
  void PutColumn(std::size_t place, CsvColumn column);

  /// (rows of the table)
  std::vector<bool> IsBaseRow() const;
  /// Motion of the base rows through the positions; empty without an axis.
  const Motion& Passes() const;
  /// Returns the first column of that name, or the first that counts these; -1:
  /// none.
  std::ptrdiff_t FirstCalled(Word word) const;
  std::ptrdiff_t FirstThatCounts(Counted counted) const;
};

}  // namespace errmap::data
