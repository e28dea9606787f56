#pragma once

#include <optional>
#include <string_view>

namespace errmap::data {

inline constexpr double kSecondsOfDay = 86400.0;

/// Which number comes first in "03/04/2024". A year of four digits, or points,
/// make it unambiguous. kYearFirst: "24/03/04" is in March. kNoDate: "08.05.12"
/// is a time of day.
enum class DateOrder { kDayFirst, kMonthFirst, kYearFirst, kNoDate };

struct DateTime {
  /// Seconds from 1970-01-01T00:00:00, or from midnight if there is no date.
  double seconds = 0.0;
  bool has_date = false;
  bool has_time = false;   // else midnight
  bool in_halves = false;  // by AM and PM, as where months come first
  bool by_order = false;   // another DateOrder reads another date, or none
  bool elapsed = false;    // no time of day: hours above 23, or minutes
};

/// A date, a time of day or both:
///
///   2024-03-01T12:00:05.25   ISO 8601, "Z" or an offset ("+01:00") at its end
///   2024-03-01 12:00         also 2024/03/01 and 2024.3.1
///   01.03.2024 12:00:05      the day first; also 1.3.24 (1970 to 2069)
///   3/1/2024 1:05 PM         in the order given
///   Fri 1-Mar-2024 12:00:05  also "1. März 2024, 12:00 Uhr", "12h05", "CET"
///   Fri Mar  1 12:00:05 2024 as C writes it; also "March 1, 2024 12:00"
///   12:00:05 01/03/2024      the time first
///   20240301 120005          also with T or _ between; 2024-061T12:00:05
///   2024. 3. 1. 12:00        also 2024_03_01 and 01MAR2024 12:00
///   1/3/2024 at 12h00m05s    also "klo", "um"; 2024-03-01T12-00-05
///   12:00:05:250             milliseconds behind a colon
///   29:00:05, 1 05:00:05     elapsed: hours, or days; 125:03.5 in minutes
///   1 day, 5:00:05           as Python writes it; also "1 days 05:00:05.5"
///
/// Returns nothing if the text is not a date or time, or names one that does
/// not exist.
std::optional<DateTime> ParseDateTime(std::string_view text,
                                      DateOrder order = DateOrder::kDayFirst);

}  // namespace errmap::data
