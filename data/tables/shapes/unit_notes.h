#pragma once

#include "data/csv.h"

namespace errmap::data {

/// Applies a unit to columns without one, with a remark. A line above or below
/// the table must state it for all columns, or for errors, positions or
/// temperatures ("All deviations in micrometres", "Units: inch, deg F",
/// "position in m").
void TakeUnitsOfNotes(CsvTable* table);

}  // namespace errmap::data
