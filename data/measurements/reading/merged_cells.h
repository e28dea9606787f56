#pragma once

#include "data/csv.h"

namespace errmap::data {

/// Fills cells of columns in which one cell applies to the empty ones below it.
/// These are the names of a day, a cycle or a direction, in the first row of
/// each block, as spreadsheets merge cells, and a thermometer that was read
/// once in every few rows. Columns at least half full, or with an empty first
/// cell, are left as they are. Remarks on it.
void FillMergedCells(CsvTable* table);

}  // namespace errmap::data
