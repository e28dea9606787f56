#pragma once

#include <cstddef>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// Converts dates and times stored as numbers to columns of text: YYYYMMDD
/// under any name (20240304), Excel's day numbers under the name of a date
/// (45355), and hours, minutes and seconds (81446) under the name of a time.
/// Columns called year, month and day (hour, minute, second) become one
/// additional column, named "Year + Month + Day". Returns the indices of the
/// columns that it joined.
std::vector<std::size_t> WriteDates(CsvTable* table);

}  // namespace errmap::data
