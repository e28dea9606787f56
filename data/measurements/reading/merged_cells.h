#pragma once

#include <cstddef>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// The columns of a table as they were meant where a cell serves for the empty
/// ones below it: what names a day, a cycle or a direction, in the first row of
/// each block as spreadsheets merge cells; a thermometer that was read once in
/// so many rows. Columns with half of their cells or more full, or with an
/// empty first cell, are none.
struct FilledColumn {
  std::size_t column;  // index into the table
  CsvColumn filled;
};
std::vector<FilledColumn> FindMergedCells(const CsvTable& table);
/// Puts them into a table, with a remark.
void FillMergedCells(const std::vector<FilledColumn>& columns, CsvTable* table);

}  // namespace errmap::data
