#pragma once

#include "data/csv.h"

namespace errmap::data {

/// Fills empty cells to which the cell above applies. In spreadsheets, merged
/// cells have the name of a day, a cycle or a direction in the first row of
/// each block. A thermometer may have been read only once in every few rows.
/// Columns at least half full, or with an empty first cell, are left unchanged.
/// Adds a remark.
void FillMergedCells(CsvTable* table);

}  // namespace errmap::data
