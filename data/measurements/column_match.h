#pragma once

#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/reading.h"

namespace errmap::data {

/// A column of a file that stands for one that a map knows.
struct MatchedColumn {
  ColumnInfo of_map;
  ColumnInfo of_file;

  bool is_converted() const {
    return of_map.unit.symbol != of_file.unit.symbol;
  }
  /// Of a value in the file, in the map's unit.
  double InMapUnit(double value) const;
  /// "t1_degC is read from 't1 [K]' and converted from K to degC", "" where
  /// name and unit are the same.
  std::string Remark() const;
};

/// The column of that name, or else the only one that has the name in another
/// unit ("t1 [K]" for "t1_degC", letters in any case). Throws InputError where
/// there is none or more than one, or where its unit cannot be converted; it
/// then ends with `remedy`.
MatchedColumn MatchColumn(
    const CsvTable& table,
    const ColumnInfo& of_map,
    const std::string& remedy = "add it or fit a map without it");

/// Gives a column that has `name` in other letters that name, where none has
/// it.
void NameLike(const std::string& name, CsvTable* table);

/// A table in the names and units of a map, and what was done for it.
struct TableForMap {
  CsvTable table;
  std::vector<std::string> remarks;  // one line for each column that differs
  Reading reading = {};              // of its rows
  /// Rows of the file, where they were put in order of time; else empty.
  std::vector<Eigen::Index> order = {};
};

/// The target of a map, and the column that a user names for it, or "": one of
/// the table, or a derived one (reading/derived_columns.h).
struct TargetOfMap {
  ColumnInfo column;
  std::string named = {};
};

/// Renames and converts the columns that stand for those of the map; throws as
/// MatchColumn does. `target` may be null.
TableForMap InMapUnits(CsvTable table,
                       const std::vector<ColumnInfo>& inputs,
                       const TargetOfMap* target = nullptr);

}  // namespace errmap::data
