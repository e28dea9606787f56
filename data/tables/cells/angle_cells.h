#pragma once

#include <optional>
#include <string_view>

#include "data/csv.h"

namespace errmap::data {

/// Reads an angle in degrees, minutes and, if it has them, seconds
/// ("-27\u00b030'15.5\"", "27\u00b0 30.5'"), in degrees.
std::optional<double> ReadAngle(std::string_view cell, bool decimal_comma);

/// Converts columns whose cells are all such angles, or missing. "[deg]"
/// becomes part of the name.
void TakeAngleCells(bool decimal_comma, CsvTable* table);

}  // namespace errmap::data
