#pragma once

#include <string>

#include "data/csv.h"

namespace errmap::data {

/// Gives errors whose names have no unit the one that a line above the table
/// states of all ("All deviations in micrometres", "Units: mm"), with a remark,
/// and positions, where it is not said of errors alone.
void TakeUnitOfNotes(CsvTable* table);

/// The line above the table that calls an error the nominal value less the
/// actual one ("Abweichung = Soll - Ist"); null without one.
const std::string* NoteOfOppositeSign(const CsvTable& table);

}  // namespace errmap::data
