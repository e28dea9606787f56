#pragma once

#include <string>

#include "data/csv.h"

namespace errmap::data {

/// Applies a unit to columns without one, with a remark. A line above or below
/// the table must state it for all columns, or for errors, positions or
/// temperatures ("All deviations in micrometres", "Units: inch, deg F",
/// "position in m").
void TakeUnitsOfNotes(CsvTable* table);

/// Returns the line above or below a table that states the sign of an error,
/// unless it clearly means actual minus nominal ("Abweichung = Soll - Ist",
/// "positive error: the axis stops short"); null without one.
const std::string* NoteOfOtherSign(const CsvTable& table);

}  // namespace errmap::data
