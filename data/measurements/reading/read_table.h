#pragma once

#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/axis/axis.h"
#include "data/measurements/axis/counting.h"
#include "data/measurements/column_roles.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/reading.h"
#include "data/measurements/sessions.h"

namespace errmap::data {

/// A table as understood: rows in order of time, and columns derived from its
/// values (direction, cycle, an error from a correction).
struct ReadTable {
  CsvTable table;  // may use the numbers of the one given: do not outlive it
  ColumnRoles roles;
  /// Rows of the given table, if they were sorted by time.
  std::vector<Eigen::Index> order;
  std::vector<ColumnFilter> where;          // of the selection, direction too
  std::vector<bool> passes;                 // (rows of the table)
  std::vector<Eigen::Index> repeated_rows;  // that pass
  std::vector<Eigen::Index> log_rows;       // that pass; none without a log
  FoundSessions found;                      // of those
  Axis axis;
  std::vector<Counter> counters;
  std::vector<std::size_t> date_parts;  // of a date that is one more column
  std::string position;                 // column of the axis, or ""
  Reading reading;
};

/// Finds the meaning of each column, row and pause of a table: see reading.h.
/// Throws InputError as MakeDataset does, OpenQuestion if no reading is
/// cautious enough.
ReadTable ReadRoles(const CsvTable& table, const DatasetSelection& selection);

/// Reads rows for a map in use, whose columns are known. Finds order, axis,
/// clock, cycles and sessions. The selection may name target, position (else
/// there is none), time and session. Throws InputError if a named column is
/// unusable.
ReadTable ReadRowsForMap(const CsvTable& table,
                         const DatasetSelection& selection);

}  // namespace errmap::data
