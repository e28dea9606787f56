#include "data/measurements/date_time.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>

#include "data/text.h"

namespace errmap::data {
namespace {

constexpr double kMinute = 60.0;
constexpr double kHour = 3600.0;
constexpr int kHoursOfHalfADay = 12;

// Takes what it reads off the front of a text.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  bool done() const { return rest_.empty(); }

  bool Take(char c) {
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }

  bool TakeIgnoringCase(std::string_view word) {
    if (!StartsWithIgnoringCase(rest_, word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }

  // Of the characters of `some`; nothing where another comes next.
  std::optional<char> TakeOneOf(std::string_view some) {
    if (done() || some.find(rest_.front()) == std::string_view::npos) {
      return std::nullopt;
    }
    const char taken = rest_.front();
    rest_.remove_prefix(1);
    return taken;
  }

  struct Number {
    int value = 0;
    std::size_t digits = 0;
  };
  // Of one to `most` digits.
  std::optional<Number> TakeNumber(std::size_t most) {
    Number number;
    while (number.digits < most && !done() && IsDigit(rest_.front())) {
      number.value = 10 * number.value + (rest_.front() - '0');
      ++number.digits;
      rest_.remove_prefix(1);
    }
    return number.digits > 0 ? std::optional(number) : std::nullopt;
  }

  // Of letters; those of other alphabets are bytes above 0x7F.
  std::string_view TakeWord() {
    std::size_t size = 0;
    while (size < rest_.size() && IsLetter(rest_[size])) ++size;
    const std::string_view word = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return word;
  }

  // Whether a letter is the next but for points, blanks and dashes.
  bool WordIsNear() const {
    const std::size_t at = rest_.find_first_not_of(". -/");
    return at != std::string_view::npos && at > 0 && IsLetter(rest_[at]) &&
           rest_.find_first_of("0123456789", at) > at + 2;
  }

  // Exactly two digits, at most `most`.
  std::optional<int> TakePair(int most) {
    const auto number = TakeNumber(2);
    if (!number || number->digits != 2 || number->value > most) {
      return std::nullopt;
    }
    return number->value;
  }

  // Whether the last fraction was there, be it 0.
  bool TookPoint() const { return took_point_; }

  // Of a point or comma and digits; 0 where there is none.
  double TakeFraction() {
    took_point_ = TakeOneOf(".,").has_value();
    if (!took_point_) return 0.0;
    double value = 0.0;
    double place = 1.0;
    while (!done() && IsDigit(rest_.front())) {
      value = 10.0 * value + (rest_.front() - '0');
      place *= 10.0;
      rest_.remove_prefix(1);
    }
    return value / place;
  }

 private:
  static bool IsDigit(char c) { return c >= '0' && c <= '9'; }
  static bool IsLetter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           static_cast<unsigned char>(c) > 0x7FU;
  }

  std::string_view rest_;
  bool took_point_ = false;
};

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

std::optional<double> TakeDate(Scanner* text, DateOrder order) {
  const auto first = text->TakeNumber(4);
  if (first && first->digits <= 2 && text->WordIsNear()) {
    return TakeNamedMonth(text, *first);
  }
  const auto separator = text->TakeOneOf("-/.");
  if (!first || !separator) return std::nullopt;
  const auto second = text->TakeNumber(2);
  if (!second || !text->Take(*separator)) return std::nullopt;
  const auto third = text->TakeNumber(4);
  if (!third) return std::nullopt;
  if (first->digits == 4) {
    // ISO 8601 has all digits; others do as they like.
    const bool whole = second->digits == 2 && third->digits == 2;
    if (third->digits > 2 || (*separator == '-' && !whole)) return std::nullopt;
    return DaysSeconds(first->value, second->value, third->value);
  }
  if (first->digits > 2 || (third->digits != 2 && third->digits != 4)) {
    return std::nullopt;
  }
  const bool day_first = *separator == '.' || order == DateOrder::kDayFirst;
  const Scanner::Number& day = day_first ? *first : *second;
  const Scanner::Number& month = day_first ? *second : *first;
  return DaysSeconds(WholeYear(*third), month.value, day.value);
}

// The hour of a day of two halves, which begin with 12.
std::optional<int> HourOf(int hour, bool afternoon) {
  if (hour < 1 || hour > kHoursOfHalfADay) return std::nullopt;
  return hour % kHoursOfHalfADay + (afternoon ? kHoursOfHalfADay : 0);
}

// Of "8:05", "08:05:12.5", "08h05" and, elapsed, "29:05:12" or
// "125:03.5" in minutes; with AM or PM, or "Uhr".
// `points`: also "08.05.12", which may be a date.
std::optional<double> TakeTime(Scanner* text, bool points, DateTime* parsed) {
  constexpr std::size_t kMostDigits = 4;
  const auto number = text->TakeNumber(kMostDigits);
  const auto mark = text->TakeOneOf(points ? ":hH." : ":hH");
  if (!number || !mark) return std::nullopt;
  const auto minute = text->TakePair(59);
  if (!minute) return std::nullopt;
  std::optional<int> hour = number->value;
  double seconds = kMinute * *minute;
  if (text->Take(*mark)) {
    const auto second = text->TakePair(60);  // a leap second, too
    if (!second) return std::nullopt;
    seconds += *second + text->TakeFraction();
  } else if (!parsed->has_date && *mark == ':') {
    if (const double fraction = text->TakeFraction(); text->TookPoint()) {
      parsed->elapsed = true;
      return kMinute * *hour + *minute + fraction;
    }
  }
  text->Take(' ');
  const bool am =
      text->TakeIgnoringCase("am") || text->TakeIgnoringCase("a.m.");
  if (am || text->TakeIgnoringCase("pm") || text->TakeIgnoringCase("p.m.")) {
    hour = HourOf(*hour, !am);
    parsed->in_halves = true;
  }
  text->TakeIgnoringCase("Uhr");
  if (!hour || (parsed->has_date && *hour > 23)) return std::nullopt;
  // "24:00" ends a day; beyond it hours go on.
  const double of_day = kHour * *hour + seconds;
  parsed->elapsed = parsed->elapsed || of_day > kSecondsOfDay;
  return of_day;
}

// Of "Z", "UTC", "CET", "+01", "+01:00" or "-0530"; 0 where the text is at its
// end. Of a zone's letters the hours count alone: they are the same down a file
// but for summer time.
std::optional<double> TakeOffset(Scanner* text) {
  constexpr auto kSummer = std::to_array<std::string_view>(
      {"CEST", "MESZ", "BST", "EEST", "EDT", "CDT", "MDT", "PDT"});
  text->Take(' ');
  if (const std::string_view zone = text->TakeWord(); !zone.empty()) {
    constexpr std::size_t kMostLetters = 5;
    const bool are_capitals =
        std::ranges::all_of(zone, [](char c) { return c >= 'A' && c <= 'Z'; });
    if (!are_capitals || zone.size() > kMostLetters ||
        (zone.size() == 1 && zone != "Z")) {
      return std::nullopt;
    }
    if (text->done()) {
      return std::ranges::count(kSummer, zone) > 0 ? kHour : 0.0;
    }
  }
  if (text->done()) return 0.0;
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

// Of "2 03:04:05" and "2.03:04:05", elapsed: the days, else 0.
double TakeDays(Scanner* text) {
  Scanner ahead = *text;
  const auto days = ahead.TakeNumber(4);
  if (!days || !ahead.TakeOneOf(" .d")) return 0.0;
  ahead.Take(' ');
  Scanner rest = ahead;
  const auto hour = rest.TakeNumber(2);
  if (!hour || !rest.Take(':')) return 0.0;
  *text = ahead;
  return kSecondsOfDay * days->value;
}

}  // namespace

std::optional<DateTime> ParseDateTime(std::string_view text, DateOrder order) {
  const std::string_view trimmed = Trimmed(text);
  const std::size_t digits = trimmed.find_first_not_of("0123456789");
  if (digits == std::string_view::npos) return std::nullopt;
  Scanner scanner(trimmed);
  DateTime parsed;
  if (digits == 0) {  // "Mon 02 Mar 2026", "Mo, 02.03.2026"
    if (scanner.TakeWord().empty() || !scanner.TakeOneOf(" ,.")) {
      return std::nullopt;
    }
    scanner.Take(' ');
  }
  const Scanner begin = scanner;
  if (trimmed[digits] != ':' && order != DateOrder::kNoDate) {
    if (const auto date = TakeDate(&scanner, order)) {
      parsed.seconds = *date;
      parsed.has_date = true;
      parsed.by_order =
          digits <= 2 && (trimmed[digits] == '/' || trimmed[digits] == '-');
      if (scanner.done()) return parsed;
      if (!scanner.TakeOneOf("T ,_")) return std::nullopt;
      scanner.Take(' ');
    } else {
      scanner = begin;
      parsed.seconds = TakeDays(&scanner);
      parsed.elapsed = parsed.seconds > 0.0;
      if (digits == 0) return std::nullopt;
    }
  }
  const bool points = parsed.has_date || order == DateOrder::kNoDate;
  const auto time = TakeTime(&scanner, points, &parsed);
  if (!time) return std::nullopt;
  const auto offset = TakeOffset(&scanner);
  if (!offset || !scanner.done()) return std::nullopt;
  parsed.seconds += *time - *offset;
  parsed.has_time = true;
  return parsed;
}

}  // namespace errmap::data
