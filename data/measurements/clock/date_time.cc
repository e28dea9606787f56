#include "data/measurements/clock/date_time.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "data/measurements/clock/clock_zone.h"
#include "data/measurements/clock/date_scanner.h"
#include "data/text.h"

namespace errmap::data {
namespace {

constexpr double kMinute = 60.0;
constexpr double kHour = 3600.0;
constexpr int kHoursOfHalfADay = 12;

using Scanner = DateScanner;

// Two digits are a year from 1970 to 2069.
int WholeYear(const Scanner::Number& year) {
  constexpr int kFirst = 70;
  if (year.digits != 2) return year.value;
  return year.value + (year.value >= kFirst ? 1900 : 2000);
}

std::optional<double> DaysSeconds(int year, int month, int day) {
  const std::chrono::year_month_day date(
      std::chrono::year(year),
      std::chrono::month(static_cast<unsigned>(month)),
      std::chrono::day(static_cast<unsigned>(day)));
  if (!date.ok()) return std::nullopt;
  return kSecondsOfDay *
         static_cast<double>(
             std::chrono::sys_days(date).time_since_epoch().count());
}

// By how its name begins in English, German, French, Italian, Spanish,
// Portuguese and Swedish; 0: none.
int TakeMonth(Scanner* text) {
  constexpr auto kMonths =
      std::to_array<std::string_view>({"jan gen ene",
                                       "feb fev f\u00e9v",
                                       "mar mrz m\u00e4r",
                                       "apr avr abr",
                                       "may mai mag maj",
                                       "jun juin giu",
                                       "jul juil lug",
                                       "aug aout ao\u00fb ago",
                                       "sep set",
                                       "oct okt ott out",
                                       "nov",
                                       "dec dez dic d\u00e9c"});
  const std::string_view word = text->TakeWord();
  const auto month = std::ranges::find_if(kMonths, [&](std::string_view names) {
    return std::ranges::any_of(SplitWords(names), [&](std::string_view name) {
      return StartsWithIgnoringCase(word, name);
    });
  });
  return month == kMonths.end() ? 0
                                : static_cast<int>(month - kMonths.begin()) + 1;
}

// Of "02-Mar-2026", "2. M\u00e4rz 2026", "02 Mar 26".
std::optional<double> TakeNamedMonth(Scanner* text,
                                     const Scanner::Number& day) {
  while (text->TakeOneOf(". -/")) {
  }
  const int month = TakeMonth(text);
  while (text->TakeOneOf(". -/")) {
  }
  const auto year = text->TakeNumber(4);
  if (month == 0 || !year || (year->digits != 2 && year->digits != 4)) {
    return std::nullopt;
  }
  return DaysSeconds(WholeYear(*year), month, day.value);
}

// Of "0304" behind the year of "20240304".
std::optional<double> TakePacked(Scanner* text, int year) {
  const auto month = text->TakePair(12);
  const auto day = month ? text->TakePair(31) : std::nullopt;
  return day ? DaysSeconds(year, *month, *day) : std::nullopt;
}

// Of the day of a year, from 1 on.
std::optional<double> DayOfYear(int year, int day) {
  const auto first = DaysSeconds(year, 1, 1);
  const auto next = DaysSeconds(year + 1, 1, 1);
  if (!first || !next || day < 1) return std::nullopt;
  const double seconds = *first + kSecondsOfDay * (day - 1);
  return seconds < *next ? std::optional(seconds) : std::nullopt;
}

// Of "W22-7" behind the year of "2024-W22-7": Monday is 1, and 4 January is in
// the first week (ISO 8601).
std::optional<double> TakeWeek(Scanner* text, int year) {
  const auto week = text->TakePair(53);
  if (!week || *week == 0) return std::nullopt;
  text->Take('-');
  const auto day = text->TakeNumber(1);
  const auto january = DaysSeconds(year, 1, 4);
  if (!day || day->value < 1 || day->value > 7 || !january) return std::nullopt;
  const double days = *january / kSecondsOfDay;  // from a Thursday
  const double monday = days - std::fmod(days + 3.0, 7.0);
  return kSecondsOfDay * (monday + 7.0 * (*week - 1) + day->value - 1);
}

std::optional<double> TakeDate(Scanner* text,
                               DateOrder order,
                               DateTime* parsed) {
  const auto first = text->TakeNumber(4);
  if (!first) return std::nullopt;
  if (first->digits <= 2 && text->WordIsNear()) {
    return TakeNamedMonth(text, *first);
  }
  if (first->digits == 4 && text->AtDigit()) {
    return TakePacked(text, first->value);
  }
  const auto separator = text->TakeOneOf("-/._");
  if (!separator) return std::nullopt;
  if (first->digits == 4 && *separator == '-' && text->Take('W')) {
    return TakeWeek(text, first->value);
  }
  // "2024. 3. 4." of Korea, "4. 3. 2024" of Bohemia.
  if (*separator == '.') text->TakeBlanks();
  const auto second = text->TakeNumber(3);
  if (!second) return std::nullopt;
  if (second->digits == 3) {
    if (first->digits != 4 || *separator == '.') return std::nullopt;
    return DayOfYear(first->value, second->value);
  }
  if (!text->Take(*separator)) return std::nullopt;
  if (*separator == '.') text->TakeBlanks();
  const auto third = text->TakeNumber(4);
  if (!third) return std::nullopt;
  if (*separator == '.') text->Take('.');
  if (first->digits == 4) {
    // ISO 8601 has all digits; others do as they like.
    const bool whole = second->digits == 2 && third->digits == 2;
    if (third->digits > 2 || (*separator == '-' && !whole)) return std::nullopt;
    return DaysSeconds(first->value, second->value, third->value);
  }
  if (first->digits > 2 || (third->digits != 2 && third->digits != 4)) {
    return std::nullopt;
  }
  parsed->by_order = *separator != '.';
  if (order == DateOrder::kYearFirst && parsed->by_order) {
    if (first->digits != 2 || third->digits != 2) return std::nullopt;
    return DaysSeconds(WholeYear(*first), second->value, third->value);
  }
  const bool day_first = *separator == '.' || order == DateOrder::kDayFirst;
  const Scanner::Number& day = day_first ? *first : *second;
  const Scanner::Number& month = day_first ? *second : *first;
  return DaysSeconds(WholeYear(*third), month.value, day.value);
}

// Of "08h05m12s", where digits follow; "8:05m" is none.
bool TakeMinuteSign(Scanner* text) {
  Scanner ahead = *text;
  if (!ahead.Take('m') || !ahead.AtDigit()) return false;
  *text = ahead;
  return true;
}

// "at", "klo", "-" between a date and its time, with the blanks around them.
void TakeBetween(Scanner* text) {
  text->TakeBlanks();
  Scanner ahead = *text;
  const std::string_view word = ahead.TakeWord();
  if (IsOneOf(word, "at klo kl um \u00e0 alle las")) {
    ahead.Take('.');
    *text = ahead;
  }
  text->Take('-');
  text->TakeBlanks();
}

// The hour of a day of two halves, which begin with 12.
std::optional<int> HourOf(int hour, bool afternoon) {
  if (hour < 1 || hour > kHoursOfHalfADay) return std::nullopt;
  return hour % kHoursOfHalfADay + (afternoon ? kHoursOfHalfADay : 0);
}

// Of "AM", "p.m.", "a. m.": whether it is the second half of the day.
std::optional<bool> TakeHalf(Scanner* text) {
  Scanner ahead = *text;
  const auto half = ahead.TakeOneOf("aApP");
  if (!half) return std::nullopt;
  const bool has_point = ahead.Take('.');
  if (has_point) ahead.TakeBlanks();
  if (!ahead.TakeOneOf("mM") || (has_point && !ahead.Take('.'))) {
    return std::nullopt;
  }
  *text = ahead;
  return *half == 'p' || *half == 'P';
}

// Of "8:05", "8h05" and, as in Quebec, "8 h 05".
std::optional<char> TakeMark(Scanner* text, std::string_view marks) {
  Scanner ahead = *text;
  ahead.TakeBlanks();
  const auto mark = ahead.TakeOneOf("hH");
  if (!mark) return text->TakeOneOf(marks);
  ahead.TakeBlanks();
  *text = ahead;
  return mark;
}

// Of "8:05", "08:05:12.5", "08h05", "08h05m12s" and, elapsed, "29:05:12" or
// "125:03.5" in minutes; with AM or PM on either side, or "Uhr".
// `points`: also "08.05.12", which may be a date, and behind one "08-05-12".
std::optional<double> TakeTime(Scanner* text, bool points, DateTime* parsed) {
  constexpr std::size_t kMostDigits = 4;
  std::optional<bool> afternoon = TakeHalf(text);
  text->TakeBlanks();
  const auto number = text->TakeNumber(kMostDigits);
  const auto mark = TakeMark(text,
                             parsed->has_date ? ":.-_"
                             : points         ? ":."
                                              : ":");
  if (!number || !mark) return std::nullopt;
  const auto minute = text->TakePair(59);
  if (!minute) return std::nullopt;
  std::optional<int> hour = number->value;
  double seconds = kMinute * *minute;
  if (text->Take(*mark) || TakeMinuteSign(text)) {
    const auto second = text->TakePair(60);  // a leap second, too
    if (!second) return std::nullopt;
    seconds += *second + text->TakeFraction();
    text->Take('s');
  } else if (!parsed->has_date && *mark == ':') {
    if (const double fraction = text->TakeFraction(); text->TookPoint()) {
      parsed->elapsed = true;
      return kMinute * *hour + *minute + fraction;
    }
  }
  text->TakeBlanks();
  if (!afternoon) afternoon = TakeHalf(text);
  if (afternoon) {
    hour = HourOf(*hour, *afternoon);
    parsed->in_halves = true;
  }
  text->TakeIgnoringCase("Uhr");
  if (!hour || (parsed->has_date && *hour > 23)) return std::nullopt;
  // "24:00" ends a day; beyond it hours go on.
  const double of_day = kHour * *hour + seconds;
  parsed->elapsed = parsed->elapsed || of_day > kSecondsOfDay;
  return of_day;
}

// What a zone's letters add to the hours of its winter: they are the same down
// a file but for summer time. Nothing if they match no zone.
std::optional<double> SecondsOfZone(std::string_view zone) {
  constexpr std::size_t kMostLetters = 5;
  const bool are_capitals =
      std::ranges::all_of(zone, [](char c) { return c >= 'A' && c <= 'Z'; });
  if (!are_capitals || zone.size() > kMostLetters ||
      (zone.size() == 1 && zone != "Z")) {
    return std::nullopt;
  }
  return IsSummerTime(zone) ? kHour : 0.0;
}

// Of "Z", "UTC", "CET", "+01", "+01:00" or "-0530"; 0 where the text is at its
// end.
std::optional<double> TakeOffset(Scanner* text) {
  text->Take(' ');
  const auto of_zone = SecondsOfZone(text->TakeWord());
  if (!of_zone || text->done()) return of_zone;
  const auto sign = text->TakeOneOf("+-");
  if (!sign) return std::nullopt;
  const auto hour = text->TakePair(23);
  if (!hour) return std::nullopt;
  double seconds = kHour * *hour;
  if (text->Take(':') || !text->done()) {
    const auto minute = text->TakePair(59);
    if (!minute) return std::nullopt;
    seconds += kMinute * *minute;
  }
  return *sign == '+' ? seconds : -seconds;
}

// Of "2 03:04:05", "2.03:04:05" and "2 days, 3:04:05", elapsed: the days, else
// 0.
double TakeDays(Scanner* text) {
  Scanner ahead = *text;
  const auto days = ahead.TakeNumber(4);
  if (!days) return 0.0;
  const bool is_apart = ahead.TakeOneOf(" .").has_value();
  const bool is_named = ahead.TakeIgnoringCase("days") ||
                        ahead.TakeIgnoringCase("day") || ahead.Take('d');
  if (!is_apart && !is_named) return 0.0;
  ahead.Take(',');
  ahead.TakeBlanks();
  Scanner rest = ahead;
  const auto hour = rest.TakeNumber(2);
  if (!hour || !rest.Take(':')) return 0.0;
  *text = ahead;
  return kSecondsOfDay * days->value;
}

// Of "081446.5" or "0814" behind a packed date.
std::optional<double> TakePackedTime(Scanner* text) {
  const auto hour = text->TakePair(23);
  const auto minute = hour ? text->TakePair(59) : std::nullopt;
  if (!minute || (!text->done() && !text->AtDigit())) return std::nullopt;
  const double seconds = kHour * *hour + kMinute * *minute;
  if (text->done()) return seconds;
  const auto second = text->TakePair(60);
  if (!second) return std::nullopt;
  return seconds + *second + text->TakeFraction();
}

// A time of day that ends the text, with a zone.
std::optional<DateTime> WithTime(Scanner text, bool points, DateTime parsed) {
  Scanner ahead = text;
  auto time = parsed.has_date ? TakePackedTime(&ahead) : std::nullopt;
  if (time) {
    text = ahead;
  } else {
    time = TakeTime(&text, points, &parsed);
  }
  if (!time) return std::nullopt;
  const auto offset = TakeOffset(&text);
  if (!offset || !text.done()) return std::nullopt;
  parsed.seconds += *time - *offset;
  parsed.has_time = true;
  return parsed;
}

// "2024-03-04", "4 Mar 2024 08:14:46".
std::optional<DateTime> ReadDateFirst(Scanner text, DateOrder order) {
  DateTime parsed;
  const auto date = TakeDate(&text, order, &parsed);
  if (!date) return std::nullopt;
  parsed.seconds = *date;
  parsed.has_date = true;
  if (text.done()) return parsed;
  if (!text.TakeOneOf("T ,_:-")) return std::nullopt;
  TakeBetween(&text);
  return WithTime(text, true, parsed);
}

// "08:14:46 04/03/2024".
std::optional<DateTime> ReadTimeFirst(Scanner text, DateOrder order) {
  constexpr double kMostOfDay = kSecondsOfDay - 1e-9;
  DateTime parsed;
  const auto time = TakeTime(&text, false, &parsed);
  if (!time || *time > kMostOfDay) return std::nullopt;
  text.Take(',');
  text.TakeBlanks();
  const auto date = TakeDate(&text, order, &parsed);
  if (!date || !text.done()) return std::nullopt;
  parsed.seconds = *date + *time;
  parsed.has_date = parsed.has_time = true;
  parsed.elapsed = false;
  return parsed;
}

// "Mar 4, 2024 08:14:46" and, as C writes them, "Mar  4 08:14:46 CET 2024".
std::optional<DateTime> ReadMonthFirst(Scanner text) {
  const int month = TakeMonth(&text);
  text.Take('.');
  text.TakeBlanks();
  const auto day = text.TakeNumber(2);
  if (month == 0 || !day) return std::nullopt;
  text.Take(',');
  text.TakeBlanks();
  DateTime parsed{.has_date = true};
  Scanner behind = text;
  const auto time = TakeTime(&behind, false, &parsed);
  double offset = 0.0;
  if (time) {
    behind.TakeBlanks();
    const auto of_zone = SecondsOfZone(behind.TakeWord());
    if (!of_zone) return std::nullopt;
    offset = *of_zone;
    behind.TakeBlanks();
    text = behind;
  }
  const auto year = text.TakeNumber(4);
  if (!year || year->digits != 4) return std::nullopt;
  const auto date = DaysSeconds(year->value, month, day->value);
  if (!date) return std::nullopt;
  parsed.seconds = *date + time.value_or(0.0) - offset;
  parsed.has_time = time.has_value();
  if (text.done()) return parsed;
  text.Take(',');
  TakeBetween(&text);
  return time ? std::nullopt : WithTime(text, false, parsed);
}

// "Mon ", "Mo, "; else nothing.
std::optional<Scanner> BehindWeekday(Scanner text) {
  if (text.TakeWord().empty() || !text.TakeOneOf(" ,.")) return std::nullopt;
  text.TakeBlanks();
  return text;
}

std::optional<DateTime> ReadWithoutDate(Scanner text, bool points) {
  DateTime parsed;
  parsed.seconds = TakeDays(&text);
  parsed.elapsed = parsed.seconds > 0.0;
  return WithTime(text, points, parsed);
}

// "2024/3/4 8:41:39" of "2024\u5e743\u67084\u65e5 8\u664241\u520639\u79d2",
// its year perhaps of the era Reiwa; "" for ASCII.
std::string WithoutCharacters(std::string_view text) {
  constexpr std::string_view kYear = "\u5e74";
  constexpr std::string_view kReiwa = "\u4ee4\u548c";
  constexpr auto kMarks =
      std::to_array<std::pair<std::string_view, std::string_view>>(
          {{kYear, "/"},
           {"\u6708", "/"},
           {"\u65e5", " "},
           {"\u6642", ":"},
           {"\u65f6", ":"},
           {"\u5206", ":"},
           {"\u79d2", ""},
           {"\u4e0a\u5348", "AM "},
           {"\uc624\uc804", "AM "},
           {"\u4e0b\u5348", "PM "},
           {"\uc624\ud6c4", "PM "}});
  if (std::ranges::all_of(text, [](unsigned char c) { return c < 0x80U; }))
    return "";
  const std::size_t year = text.find(kYear);
  std::string plain(text);
  if (text.starts_with(kReiwa) && year != text.npos) {
    double number = 0.0;
    if (!ParseNumber(text.substr(kReiwa.size(), year - kReiwa.size()),
                     &number)) {
      return "";
    }
    plain.replace(0, year, std::to_string(2018 + static_cast<int>(number)));
  }
  for (const auto& [character, mark] : kMarks) {
    for (std::size_t at = plain.find(character); at != plain.npos;
         at = plain.find(character)) {
      plain.replace(at, character.size(), mark);
    }
  }
  if (plain.ends_with(':')) plain.pop_back();  // no seconds
  return plain;
}

}  // namespace

std::optional<DateTime> ParseDateTime(std::string_view text, DateOrder order) {
  const std::string plain = WithoutCharacters(text);
  std::string_view trimmed = Trimmed(plain.empty() ? text : plain);
  if (trimmed.starts_with('[') && trimmed.ends_with(']')) {
    trimmed = trimmed.substr(1, trimmed.size() - 2);
  }
  const std::size_t digits = trimmed.find_first_not_of("0123456789");
  if (digits == std::string_view::npos) return std::nullopt;
  const Scanner begin(trimmed);
  if (order == DateOrder::kNoDate) return WithTime(begin, true, {});
  if (digits > 0) {
    std::optional<DateTime> read = ReadDateFirst(begin, order);
    if (!read) read = ReadTimeFirst(begin, order);
    return read ? read : ReadWithoutDate(begin, false);
  }
  std::optional<DateTime> read = ReadMonthFirst(begin);
  const std::optional<Scanner> behind = BehindWeekday(begin);
  if (!read && behind) read = ReadDateFirst(*behind, order);
  if (!read && behind) read = ReadMonthFirst(*behind);
  return read ? read : ReadWithoutDate(begin, false);
}

}  // namespace errmap::data
