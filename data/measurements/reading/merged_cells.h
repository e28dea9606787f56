#pragma once

#include <cstddef>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// Fills cells of columns in which one cell applies to the empty ones below it.
/// These are the names of a day, a cycle or a direction, in the first row of
/// each block, as spreadsheets merge cells, and a thermometer that was read
/// once in every few rows. Columns at least half full, or with an empty first
/// cell, are left as they are.
struct FilledColumn {
  std::size_t column;  // index into the table
  CsvColumn filled;
};
std::vector<FilledColumn> FindMergedCells(const CsvTable& table);
/// Puts the columns into a table, with a remark.
void FillMergedCells(const std::vector<FilledColumn>& columns, CsvTable* table);

}  // namespace errmap::data
