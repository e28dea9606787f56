#pragma once

#include "data/csv.h"

namespace errmap::data {

/// Converts a table with a row for each value (time, position, variable, value)
/// into one with a row for all values that share their other cells. Each
/// variable gets a column in its unit ("T1 [degC]"), with a remark. Does so
/// only if a column of words names an error among other variables and another
/// column is called a value.
void SpreadReadings(CsvTable* table);

/// Transposes a table with a row for each variable, including an error, and a
/// column for each reading, with a remark.
void TurnTable(CsvTable* table);

}  // namespace errmap::data
