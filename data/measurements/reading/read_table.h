#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/column_roles.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/axis.h"
#include "data/measurements/reading/counting.h"
#include "data/measurements/reading/reading.h"
#include "data/measurements/sessions.h"

namespace errmap::data {

/// A table with what was found in it: rows in order of time, and columns of
/// what its values say (direction, cycle, an error for a correction).
struct ReadTable {
  /// Nothing: the table as it was given. Its numbers may be those of the table
  /// given, which must outlive it.
  std::optional<CsvTable> table;
  ColumnRoles roles;
  /// Rows of the table given, where they were put in order of time.
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

/// Reads what each column, row and pause of a table means: see reading.h.
/// Throws InputError as MakeDataset does, OpenQuestion where no reading is the
/// cautious one.
ReadTable ReadRoles(const CsvTable& table, const DatasetSelection& selection);

/// Of rows for a map in use, whose columns the map knows: their order, axis,
/// clock, cycles and sessions. The selection may name target, position (else
/// there is none), time and session. Throws InputError where a column that it
/// names will not do.
ReadTable ReadRowsForMap(const CsvTable& table,
                         const DatasetSelection& selection);

}  // namespace errmap::data
