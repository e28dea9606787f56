#pragma once

#include "data/csv.h"

namespace errmap::data {

/// Gives columns without a unit the one that a line above or below the table
/// states for all, or for errors, positions or temperatures ("All deviations in
/// micrometres", "Units: inch, deg F", "position in m"), with a remark.
void TakeUnitsOfNotes(CsvTable* table);

}  // namespace errmap::data
