#pragma once

#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// Dates that a table holds as numbers, as columns of text in their place:
/// YYYYMMDD whatever the name (20240304), days as Excel counts them under the
/// name of a date (45355), hours, minutes and seconds (81446) under the name
/// of a time. Columns called year, month and day (hour, minute, second) become
/// one more, named "Year + Month + Day". Indices and texts; the rest of the
/// table stays as it is.
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
