#pragma once

#include "data/csv.h"

namespace errmap::data {

/// Makes of a table with a row for each variable, an error among them, and a
/// column for each reading one with a row for each reading, with a remark.
void TurnTable(CsvTable* table);

}  // namespace errmap::data
