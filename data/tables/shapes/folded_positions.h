#pragma once

#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// Makes of a row with a column for each position, as "e@-215.9mm_um",
/// "Error at -203.2 mm (um)", "err_50" or "50" (three or more), a row for each:
/// a column position_mm (or in their unit), one of what they hold (error_um),
/// the other columns repeated; with a remark. Likewise of a row with a column
/// for each run, as "Run 3 up [um]", or for each way, as "Error up [um]": block
/// by block where the positions begin anew. Columns that sheets make of these
/// (means, ranges) are left out. Other tables stay as they are.
void FoldPositions(CsvTable* table);

/// Whether bare numbers in names are positions (mm): three or more that go one
/// way, and not by ones as what numbers runs does.
bool AreSpacedPositions(const std::vector<double>& numbers);

}  // namespace errmap::data
