#pragma once

#include "data/csv.h"

namespace errmap::data {

/// Applies a unit to columns without one, if a line above or below the table
/// states it for all columns, or for errors, positions or temperatures ("All
/// deviations in micrometres", "Units: inch, deg F", "position in m"), with a
/// remark.
void TakeUnitsOfNotes(CsvTable* table);

}  // namespace errmap::data
