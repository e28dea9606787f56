#include "data/measurements/date_time.h"

#include <chrono>
#include <cstddef>

#include "data/text.h"

namespace errmap::data {
namespace {

constexpr double kMinute = 60.0;
constexpr double kHour = 3600.0;
constexpr double kDay = 86400.0;
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

  // Exactly two digits, at most `most`.
  std::optional<int> TakePair(int most) {
    const auto number = TakeNumber(2);
    if (!number || number->digits != 2 || number->value > most) {
      return std::nullopt;
    }
    return number->value;
  }

  // Of a point or comma and digits; 0 where there is none.
  double TakeFraction() {
    if (!TakeOneOf(".,")) return 0.0;
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

  std::string_view rest_;
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
  return kDay * static_cast<double>(
                    std::chrono::sys_days(date).time_since_epoch().count());
}

std::optional<double> TakeDate(Scanner* text, DateOrder order) {
  const auto first = text->TakeNumber(4);
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

// `in_halves`: with AM or PM.
std::optional<double> TakeTime(Scanner* text, bool* in_halves) {
  const auto number = text->TakeNumber(2);
  if (!number || number->value > 23 || !text->Take(':')) return std::nullopt;
  const auto minute = text->TakePair(59);
  if (!minute) return std::nullopt;
  double seconds = kMinute * *minute;
  if (text->Take(':')) {
    const auto second = text->TakePair(60);  // a leap second, too
    if (!second) return std::nullopt;
    seconds += *second + text->TakeFraction();
  }
  std::optional<int> hour = number->value;
  text->Take(' ');
  if (text->TakeIgnoringCase("am") || text->TakeIgnoringCase("a.m.")) {
    hour = HourOf(*hour, false);
    *in_halves = true;
  } else if (text->TakeIgnoringCase("pm") || text->TakeIgnoringCase("p.m.")) {
    hour = HourOf(*hour, true);
    *in_halves = true;
  }
  if (!hour) return std::nullopt;
  return kHour * *hour + seconds;
}

// Of "Z", "+01", "+01:00" or "-0530"; 0 where the text is at its end.
std::optional<double> TakeOffset(Scanner* text) {
  if (text->done() || text->Take('Z')) return 0.0;
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

}  // namespace

std::optional<DateTime> ParseDateTime(std::string_view text, DateOrder order) {
  const std::string_view trimmed = Trimmed(text);
  Scanner scanner(trimmed);
  DateTime parsed;
  const std::size_t digits = trimmed.find_first_not_of("0123456789");
  if (digits == std::string_view::npos) return std::nullopt;
  if (trimmed[digits] != ':') {
    const auto date = TakeDate(&scanner, order);
    if (!date) return std::nullopt;
    parsed.seconds = *date;
    parsed.has_date = true;
    parsed.by_order = digits <= 2 && trimmed[digits] != '.';
    if (scanner.done()) return parsed;
    if (!scanner.TakeOneOf("T ")) return std::nullopt;
  }
  const auto time = TakeTime(&scanner, &parsed.in_halves);
  if (!time) return std::nullopt;
  const auto offset = TakeOffset(&scanner);
  if (!offset || !scanner.done()) return std::nullopt;
  parsed.seconds += *time - *offset;
  parsed.has_time = true;
  return parsed;
}

}  // namespace errmap::data
