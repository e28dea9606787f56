#pragma once

#include "data/csv.h"

namespace errmap::data {

/// Makes of a row for each reading (time, position, variable, value) a row for
/// all readings that share their other cells, with a column for each variable
/// in its unit ("T1 [degC]"); with a remark. Only where a column of words names
/// an error among other variables and another is called a value.
void SpreadReadings(CsvTable* table);

}  // namespace errmap::data
