#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// What the texts of a column say of time.
struct TextTimes {
  /// Of each of the column's texts, from 1970 or from midnight; nothing where
  /// it is no time.
  std::vector<std::optional<double>> seconds;
  bool all = true;         // each that is not missing is a date or a time
  bool any = false;        // one of them is
  bool all_dates = true;   // of each that is
  bool any_hours = false;  // a time of day in some
  bool in_halves = false;  // by AM and PM
  bool by_order = false;   // another order reads some of them otherwise
  bool elapsed = false;    // hours that go on over 24, or days and hours
  /// "day/month/year", the order taken, where another reads other dates.
  std::string order;
};

/// Reads them by ParseDateTime. "03/04/2024" may be in March or in April: the
/// order is the one that makes all of them dates, else the one that goes back
/// in time less often down the rows, else the one by which the file lasts less
/// long, else the month with AM and PM, else the day. "27:35" is 27 min and 35
/// s where the name says mm:ss, or some are of 24 and more.
TextTimes ReadTimes(const CsvColumn& column);

/// Throws InputError, with the place and the form that works, where a column
/// that is called a time or a date looks like times by most of its cells and
/// one of them is none that ParseDateTime reads.
void RefuseUnreadTimes(const CsvTable& table);

/// Whether a column holds times or dates in words and figures, and nothing else
/// but missing cells; dates without hours.
bool HoldsTimes(const CsvColumn& column);
bool HoldsDates(const CsvColumn& column);

}  // namespace errmap::data
