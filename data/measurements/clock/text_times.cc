#include "data/measurements/clock/text_times.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "data/argument_name.h"
#include "data/column_words.h"
#include "data/measurements/clock/date_time.h"
#include "data/measurements/column_checks.h"
#include "data/text.h"

namespace errmap::data {
namespace {

// Of "27:35" two fields: minutes and seconds where the name says so, or where
// as hours they would go on over the day.
bool AreMinutesAndSeconds(const CsvColumn& column, const TextTimes& times) {
  const bool said = column.name.find("mm:ss") != column.name.npos;
  return times.any && (said || times.elapsed) &&
         std::ranges::all_of(column.texts, [](const std::string& text) {
           return IsMissingNumber(text) ||
                  (std::ranges::count(text, ':') == 1 &&
                   text.find_first_not_of("0123456789:") == text.npos);
         });
}

TextTimes ReadTimes(const CsvColumn& column, DateOrder order) {
  TextTimes times;
  for (const std::string& text : column.texts) {
    const auto parsed = ParseDateTime(text, order);
    times.seconds.push_back(parsed ? std::optional(parsed->seconds)
                                   : std::nullopt);
    if (parsed) {
      times.any = true;
      times.all_dates = times.all_dates && parsed->has_date;
      // Midnight in every row is not an hour: a sheet's date.
      const bool tells_hour =
          parsed->has_time &&
          (!parsed->has_date || std::fmod(parsed->seconds, kSecondsOfDay) != 0);
      times.any_hours = times.any_hours || tells_hour;
      times.by_order = times.by_order || parsed->by_order;
      times.in_halves = times.in_halves || parsed->in_halves;
      times.elapsed = times.elapsed || parsed->elapsed;
    } else {
      times.all = times.all && IsMissingNumber(text);
    }
  }
  if (AreMinutesAndSeconds(column, times)) {
    times.elapsed = true;
    for (auto& seconds : times.seconds) {
      if (seconds) *seconds /= 60.0;
    }
  }
  return times;
}

std::size_t TimesBack(const CsvColumn& column, const TextTimes& times) {
  std::size_t count = 0;
  double last = -INFINITY;
  for (const auto& [row, text] : column.exceptions) {
    const double now = times.seconds[text].value_or(last);
    count += now < last ? 1 : 0;
    last = now;
  }
  return count;
}

// From the first to the last of them.
double Span(const TextTimes& times) {
  double least = INFINITY;
  double most = -INFINITY;
  for (const auto& seconds : times.seconds) {
    least = std::min(least, seconds.value_or(least));
    most = std::max(most, seconds.value_or(most));
  }
  return most - least;
}

// Of two that go back as often, the one by which the file lasts less long: days
// that follow one another are months apart in the other. Else the one of people
// who write AM and PM.
bool GoesBackLess(const CsvColumn& column,
                  const TextTimes& month_first,
                  const TextTimes& day_first) {
  const std::size_t by_month = TimesBack(column, month_first);
  const std::size_t by_day = TimesBack(column, day_first);
  if (by_month != by_day) return by_month < by_day;
  const double of_month = Span(month_first);
  const double of_day = Span(day_first);
  return of_month != of_day ? of_month < of_day : month_first.in_halves;
}

// Two numbers or more of four digits together: "2024-W10-1 08.14".
bool LooksLikeTime(const std::string& text) {
  constexpr int kFewestDigits = 4;
  int digits = 0;
  int numbers = 0;
  bool in_number = false;
  for (const char c : text) {
    const bool is_digit = IsDigit(c);
    digits += is_digit ? 1 : 0;
    numbers += is_digit && !in_number ? 1 : 0;
    in_number = is_digit;
  }
  return digits >= kFewestDigits && numbers >= 2;
}

// The first row whose cell is not a time in a column that looks like times by
// most of its cells; else nothing.
std::optional<std::size_t> FirstUnreadTime(const CsvColumn& column) {
  if (!column.is_text()) return std::nullopt;
  const TextTimes times = ReadTimes(column);
  if (times.all) return std::nullopt;
  std::optional<std::size_t> first;
  std::size_t alike = 0;
  std::size_t others = 0;
  for (const auto& [row, text] : column.exceptions) {
    const std::string& cell = column.texts[text];
    if (IsMissingNumber(cell)) continue;
    ++(LooksLikeTime(cell) ? alike : others);
    if (!first && !times.seconds[text]) first = row;
  }
  return alike > others ? first : std::nullopt;
}

// What the first cell says: most columns are told by it, without the others.
std::optional<DateTime> FirstTime(const CsvColumn& column) {
  if (!column.is_text()) return std::nullopt;
  for (const std::string& text : column.texts) {
    if (IsMissingNumber(text)) continue;
    for (const DateOrder order :
         {DateOrder::kDayFirst, DateOrder::kMonthFirst, DateOrder::kNoDate}) {
      if (auto time = ParseDateTime(text, order)) return time;
    }
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

void RefuseUnreadTimes(const CsvTable& table) {
  for (const CsvColumn& column : table.columns) {
    if (!Says(column.name, Word::kTime) && !Says(column.name, Word::kDate)) {
      continue;
    }
    const std::optional<std::size_t> row = FirstUnreadTime(column);
    if (!row) continue;
    throw InputError(table.Where(*row, column.name) + ": " +
                     QuotedText(table.CellText(column, *row)) +
                     " is not a time; write it as 2024-03-01T12:00:05, or use "
                     "no clock, with " +
                     ArgumentName("time", "none"));
  }
}

TextTimes ReadTimes(const CsvColumn& column) {
  TextTimes day_first = ReadTimes(column, DateOrder::kDayFirst);
  if (day_first.all && !day_first.by_order) return day_first;
  TextTimes month_first = ReadTimes(column, DateOrder::kMonthFirst);
  if (!day_first.all && !month_first.all) {
    TextTimes hours = ReadTimes(column, DateOrder::kNoDate);
    if (hours.all) return hours;
  }
  if (day_first.seconds == month_first.seconds) return day_first;
  const bool by_month = day_first.all == month_first.all
                            ? GoesBackLess(column, month_first, day_first)
                            : month_first.all;
  day_first.order = "day/month/year";
  month_first.order = "month/day/year";
  TextTimes likeliest = by_month ? month_first : day_first;
  // Days that follow one another are years apart in another order.
  TextTimes year_first = ReadTimes(column, DateOrder::kYearFirst);
  year_first.order = "year/month/day";
  const bool by_year =
      year_first.all &&
      (!likeliest.all ||
       (TimesBack(column, year_first) <= TimesBack(column, likeliest) &&
        10.0 * Span(year_first) < Span(likeliest)));
  return by_year ? year_first : likeliest;
}

bool HoldsTimes(const CsvColumn& column) {
  if (!FirstTime(column)) return false;
  const TextTimes times = ReadTimes(column);
  return times.all && times.any;
}

bool HoldsDates(const CsvColumn& column) {
  const std::optional<DateTime> first = FirstTime(column);
  if (!first) return false;
  if (first->has_time && std::fmod(first->seconds, kSecondsOfDay) != 0.0) {
    return false;
  }
  const TextTimes times = ReadTimes(column);
  return times.all && times.any && !times.any_hours;
}

}  // namespace errmap::data
