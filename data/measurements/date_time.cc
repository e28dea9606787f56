#include "data/measurements/date_time.h"

#include <chrono>
#include <cstddef>

#include "data/text.h"

namespace errmap::data {
namespace {

constexpr double kMinute = 60.0;
constexpr double kHour = 3600.0;
constexpr double kDay = 86400.0;

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

  // Exactly this many digits, at most `most`.
  std::optional<int> Digits(std::size_t count, int most) {
    if (rest_.size() < count) return std::nullopt;
    int value = 0;
    for (const char c : rest_.substr(0, count)) {
      if (c < '0' || c > '9') return std::nullopt;
      value = 10 * value + (c - '0');
    }
    rest_.remove_prefix(count);
    return value <= most ? std::optional(value) : std::nullopt;
  }

  // Of a point or comma and digits; 0 where there is none.
  double Fraction() {
    if (!Take('.') && !Take(',')) return 0.0;
    double value = 0.0;
    double place = 1.0;
    while (!rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9') {
      value = 10.0 * value + (rest_.front() - '0');
      place *= 10.0;
      rest_.remove_prefix(1);
    }
    return value / place;
  }

 private:
  std::string_view rest_;
};

std::optional<double> TakeDate(Scanner* text) {
  constexpr int kMostYears = 9999;
  const auto year = text->Digits(4, kMostYears);
  if (!year || !text->Take('-')) return std::nullopt;
  const auto month = text->Digits(2, 12);
  if (!month || !text->Take('-')) return std::nullopt;
  const auto day = text->Digits(2, 31);
  if (!day) return std::nullopt;
  const std::chrono::year_month_day date(
      std::chrono::year(*year),
      std::chrono::month(static_cast<unsigned>(*month)),
      std::chrono::day(static_cast<unsigned>(*day)));
  if (!date.ok()) return std::nullopt;
  return kDay * static_cast<double>(
                    std::chrono::sys_days(date).time_since_epoch().count());
}

std::optional<double> TakeTime(Scanner* text) {
  const auto hour = text->Digits(2, 23);
  if (!hour || !text->Take(':')) return std::nullopt;
  const auto minute = text->Digits(2, 59);
  if (!minute) return std::nullopt;
  double seconds = kHour * *hour + kMinute * *minute;
  if (text->Take(':')) {
    const auto second = text->Digits(2, 60);  // a leap second, too
    if (!second) return std::nullopt;
    seconds += *second + text->Fraction();
  }
  return seconds;
}

// Of "Z", "+01", "+01:00" or "-0530"; 0 where the text is at its end.
std::optional<double> TakeOffset(Scanner* text) {
  if (text->done() || text->Take('Z')) return 0.0;
  const bool ahead = text->Take('+');
  if (!ahead && !text->Take('-')) return std::nullopt;
  const auto hour = text->Digits(2, 23);
  if (!hour) return std::nullopt;
  double seconds = kHour * *hour;
  if (text->Take(':') || !text->done()) {
    const auto minute = text->Digits(2, 59);
    if (!minute) return std::nullopt;
    seconds += kMinute * *minute;
  }
  return ahead ? seconds : -seconds;
}

}  // namespace

std::optional<double> ParseDateTime(std::string_view text) {
  const std::string_view trimmed = Trimmed(text);
  Scanner scanner(trimmed);
  double seconds = 0.0;
  if (const bool is_date = trimmed.find('-') == 4; is_date) {
    const auto date = TakeDate(&scanner);
    if (!date || scanner.done()) return date;
    if (!scanner.Take('T') && !scanner.Take(' ')) return std::nullopt;
    seconds = *date;
  }
  const auto time = TakeTime(&scanner);
  if (!time) return std::nullopt;
  const auto offset = TakeOffset(&scanner);
  if (!offset || !scanner.done()) return std::nullopt;
  return seconds + *time - *offset;
}

}  // namespace errmap::data
