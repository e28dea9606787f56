#pragma once

#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// Converts dates and times stored as numbers to columns of text: YYYYMMDD
/// whatever the name (20240304), Excel's day numbers if the name is that of a
/// date (45355), hours, minutes and seconds (81446) if it is that of a time.
/// Columns called year, month and day (hour, minute, second) become one
/// additional column, named "Year + Month + Day". Returns indices and texts;
/// the rest of the table is unchanged.
struct DigitDates {
  struct Rewritten {
    std::size_t column;  // its index; the number of columns for one more
    CsvColumn text;
  };
  std::vector<Rewritten> columns;
  std::vector<std::size_t> parts;  // of the column that is one more
};
DigitDates FindDigitDates(const CsvTable& table);

/// Puts them into a table.
void WriteDates(const DigitDates& dates, CsvTable* table);

}  // namespace errmap::data
