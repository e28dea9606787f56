#pragma once

#include <string>

#include "data/csv.h"

namespace errmap::data {

/// The line above or below a table that tells how an error is signed, where
/// that is not plainly the actual value less the nominal one ("Abweichung =
/// Soll - Ist", "positive error: the axis stops short"); null without one.
const std::string* NoteOfOtherSign(const CsvTable& table);

}  // namespace errmap::data
