#pragma once

#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// Converts a table with a column for each position into one with a row for
/// each, with a remark. Such columns are "e@-215.9mm_um", "Error at -203.2 mm
/// (um)", or three or more of "err_50" or "50". The new columns are position_mm
/// (or in their unit) and the values (error_um); the others are repeated. Does
/// the same for a column for each run, such as "Run 3 up [um]", or for each
/// direction, such as "Error up [um]": block by block where the positions start
/// again. Leaves out columns calculated from these (means, ranges). Other
/// tables are unchanged.
void FoldPositions(CsvTable* table);

/// True if bare numbers in names are positions (mm): three or more that always
/// rise or always fall. Steps of one are numbers of runs.
bool AreSpacedPositions(const std::vector<double>& numbers);

}  // namespace errmap::data
