#pragma once

#include <cstddef>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// The columns of a table as they were meant where a spreadsheet had merged
/// cells: what names a day, a cycle or a direction stands in the first row of
/// each block, and the others are empty. Columns without a name of such, with
/// half of their cells or more full, or with an empty first cell are none.
struct FilledColumn {
  std::size_t column;  // index into the table
  CsvColumn filled;
};
std::vector<FilledColumn> FindMergedCells(const CsvTable& table);
/// Puts them into a table, with a remark.
void FillMergedCells(const std::vector<FilledColumn>& columns, CsvTable* table);

}  // namespace errmap::data
