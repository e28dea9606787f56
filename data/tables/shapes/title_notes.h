#pragma once

#include <string>

#include "data/csv.h"

namespace errmap::data {

/// Gives columns whose names have no unit the one that a line states of all,
/// or of errors, positions or temperatures ("All deviations in micrometres",
/// "Units: inch, deg F", "position in m"), with a remark.
void TakeUnitOfNotes(CsvTable* table);

/// The line that tells how an error is signed, where that is not plainly the
/// actual value less the nominal one ("Abweichung = Soll - Ist", "positive
/// error: the axis stops short"); null without one.
const std::string* NoteOfOtherSign(const CsvTable& table);

}  // namespace errmap::data
