#pragma once

#include "data/csv.h"

namespace errmap::data {

/// Gives columns whose names have no unit the one that a line above or below
/// the table states of all, or of errors, positions or temperatures ("All
/// deviations in micrometres", "Units: inch, deg F", "position in m"), with a
/// remark.
void TakeUnitsOfNotes(CsvTable* table);

}  // namespace errmap::data
