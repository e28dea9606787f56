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

/// Clears the flags of rows that pass but hold totals or remarks, and returns
/// these rows. `group` is the column of cycles. Throws InputError if such a row
/// must not be left out.
std::vector<Eigen::Index> LeaveOutTotals(const CsvTable& table,
                                         std::ptrdiff_t group,
                                         MissingPolicy missing,
                                         std::vector<bool>* passes);

/// Chooses the rows that pass the filters, without totals and remarks. Throws
/// InputError if such a row must not be left out.
void ChooseBaseRows(TableInReading* in);

/// If rows with dates are equal in all columns, they are one reading saved
/// twice: leaves out the later ones. Returns false if there are none.
bool LeaveOutSavedTwice(TableInReading* in);

/// The purpose for which rows are read.
enum class RowsFor {
  kLearning,   // a map, of which a reading that was saved twice is one
  kAnswering,  // each row, by a map whose axis the selection names
};

/// Finds clock and axis of the base rows. If the clock shows that rows are not
/// in order of time, they are sorted by it. Rows that were rearranged and have
/// no clock get no order.
void PutInOrder(TableInReading* in, RowsFor use);

/// Finds the directions along the axis, from a column or the positions, and
/// keeps the rows of the one that the selection requests. Throws InputError if
/// no row has that direction.
void FindWays(TableInReading* in);

/// Finds the columns that count passes, directions, rows or days.
void FindColumnsThatCount(TableInReading* in);

/// Finds the cycles: in a column, else by numbering the passes in a new one.
void FindCycles(TableInReading* in);

/// If labels of cycles also name their session, the sessions become a new
/// column.
void FindBlocksInLabels(TableInReading* in);

/// Fills `reading` and `position` of in->read from the results: target, axis,
/// time, sessions, cycles, rows left out, files.
void DescribeReading(TableInReading* in);

}  // namespace errmap::data
