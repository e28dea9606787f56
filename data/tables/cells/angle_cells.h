#pragma once

#include <optional>
#include <string_view>

#include "data/csv.h"

namespace errmap::data {

/// Returns an angle in degrees, read from degrees, minutes and, if present,
/// seconds ("-27°30'15.5"", "27° 30.5'"). Nothing for other cells.
std::optional<double> ReadAngle(std::string_view cell, bool decimal_comma);

/// Converts the angles in columns that hold mostly these to degrees. Adds
/// "[deg]" to their names.
void TakeAngleCells(bool decimal_comma, CsvTable* table);

}  // namespace errmap::data
