#pragma once

#include "data/csv.h"

namespace errmap::data {

/// Transposes a table with a row for each variable, including an error, and a
/// column for each reading, with a remark.
void TurnTable(CsvTable* table);

}  // namespace errmap::data
