#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// Times in the texts of a column.
struct TextTimes {
  /// Time of each text of the column, from 1970 or from midnight; nothing if it
  /// is not a time.
  std::vector<std::optional<double>> seconds;
  bool all = true;         // each that is not missing is a date or a time
  bool any = false;        // one of them is
  bool all_dates = true;   // of each that is
  bool any_hours = false;  // a time of day in some
  bool in_halves = false;  // by AM and PM
  bool by_order = false;   // another order reads some of them otherwise
  bool elapsed = false;    // hours that go on over 24, or days and hours
  /// "day/month/year", the order used, if another order would give other dates.
  std::string order;
};

/// Reads texts by ParseDateTime. "03/04/2024" may be in March or in April.
/// These rules choose the order, in turn: all texts are dates; time goes back
/// less often from row to row; the file spans less time; the month comes first
/// with AM and PM, else the day. "27:35" is 27 min and 35 s if the name says
/// mm:ss, or some values are 24 or more.
TextTimes ReadTimes(const CsvColumn& column);

/// Throws InputError if a column named as a time or a date has times in most
/// cells, but a cell that ParseDateTime cannot read. The message has the place
/// and a valid form.
void RefuseUnreadTimes(const CsvTable& table);

/// True if a column holds only times or dates as text, and missing cells. The
/// second function: only dates without hours.
bool HoldsTimes(const CsvColumn& column);
bool HoldsDates(const CsvColumn& column);

}  // namespace errmap::data
