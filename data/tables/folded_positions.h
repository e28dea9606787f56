#pragma once

#include "data/csv.h"

namespace errmap::data {

/// Makes of a row with a column for each position, as "e@-215.9mm_um",
/// "error_um @ -203.2 mm" and so on (three or more), a row for each: a column
/// position_mm (or in their unit), one of what they hold (error_um), the other
/// columns repeated; with a remark. Other tables stay as they are.
void FoldPositions(CsvTable* table);

}  // namespace errmap::data
