#pragma once

#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/reading.h"

namespace errmap::data {

/// A column of a file that has another name or unit in the map.
struct MatchedColumn {
  ColumnInfo of_map;
  ColumnInfo of_file;

  bool is_converted() const {
    return of_map.unit.symbol != of_file.unit.symbol;
  }
  /// Converts a value in the file to the map's unit.
  double InMapUnit(double value) const;
  /// "t1_degC is read from 't1 [K]' and converted from K to degC"; "" if name
  /// and unit are the same.
  std::string Remark() const;
};

/// Returns the column of that name, or else the only one with that name in
/// another unit ("t1 [K]" for "t1_degC"), in upper or lower case. Throws
/// InputError if there is none or more than one, or its unit cannot be
/// converted. The message ends with `remedy`.
MatchedColumn MatchColumn(
    const CsvTable& table,
    const ColumnInfo& of_map,
    const std::string& remedy = "add it or fit a map without it");

/// Renames a column whose name differs from `name` only in case, unless a
/// column of that name exists.
void NameLike(const std::string& name, CsvTable* table);

/// A table in the names and units of a map, with remarks on the changes.
struct TableForMap {
  CsvTable table;
  std::vector<std::string> remarks =
      {};                // one line for each column that differs
  Reading reading = {};  // of its rows
  /// Rows of the file, if they were sorted by time; else empty.
  std::vector<Eigen::Index> order = {};
};

/// The target of a map, and the column that the user named for it, or "". It
/// may be a derived column (reading/derived_columns.h).
struct TargetOfMap {
  ColumnInfo column;
  std::string named = {};
};

/// Renames and converts the columns that match those of the map. Throws as
/// MatchColumn does. `target` may be null.
TableForMap InMapUnits(CsvTable table,
                       const std::vector<ColumnInfo>& inputs,
                       const TargetOfMap* target = nullptr);

}  // namespace errmap::data
