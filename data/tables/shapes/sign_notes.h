#pragma once

#include <string>

#include "data/csv.h"

namespace errmap::data {

/// Returns the line above or below a table that states the sign of an error,
/// unless it clearly means actual minus nominal ("Abweichung = Soll - Ist",
/// "positive error: the axis stops short"); null without one.
const std::string* NoteOfOtherSign(const CsvTable& table);

}  // namespace errmap::data
