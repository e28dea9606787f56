#include "data/measurements/clock/digit_dates.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "data/column_header.h"
#include "data/column_words.h"
#include "data/columns.h"
#include "data/measurements/clock/date_time.h"
#include "data/measurements/clock/text_times.h"
#include "data/measurements/clock/time_units.h"
#include "data/text.h"
#include "data/text_index.h"
#include "data/units.h"

namespace errmap::data {
namespace {

// A column of text where there was one of numbers. `text_of` takes a row.
template <typename TextOf>
CsvColumn AsText(const std::string& name,
                 std::size_t num_rows,
                 const TextOf& text_of) {
  std::vector<std::string> words;
  std::vector<std::ptrdiff_t> codes;
  TextIndex index;
  for (std::size_t row = 0; row < num_rows; ++row) {
    codes.push_back(index.IndexOf(text_of(row), &words));
  }
  return WordColumn(name, codes, std::move(words));
}

void WriteAs(std::string (*text_of)(double), CsvColumn* column) {
  *column = AsText(column->name, column->values.size(), [&](std::size_t row) {
    return text_of(column->values[row]);
  });
}

// Of each number that is none of the missing ones.
template <typename Is>
bool All(const CsvColumn& column, const Is& is) {
  double before = std::nan("");  // dates repeat down the rows
  for (const double value : column.values) {
    if (std::isnan(value) || value == before) continue;
    if (!is(value)) return false;
    before = value;
  }
  return !std::isnan(before);
}

std::string DateOfDigits(double digits) {
  if (!(digits >= 19800101.0 && digits < 20700101.0) ||
      digits != std::floor(digits)) {
    return "";
  }
  const auto number = static_cast<long>(digits);
  std::string date = fmt::format(
      "{:04}-{:02}-{:02}", number / 10000, number / 100 % 100, number % 100);
  return ParseDateTime(date) ? date : "";
}

// "20240304" as often as not names a part or an order: dates follow one
// another.
bool AreDatesOfDigits(const CsvColumn& column) {
  constexpr double kMostSpan = 100000.0;  // ten years
  const auto is_date = [](double value) {
    return !DateOfDigits(value).empty();
  };
  if (!All(column, is_date)) return false;
  double least = INFINITY;
  double most = -INFINITY;
  for (const double value : column.values) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  return most - least < kMostSpan;
}

std::string DateOfExcel(double days) {
  if (std::isnan(days)) return "";
  const std::chrono::year_month_day date{std::chrono::sys_days(
      std::chrono::days(static_cast<int>(days - kExcelDaysTo1970)))};
  return fmt::format("{:04}-{:02}-{:02}",
                     static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()));
}

std::string ClockOfDigits(double digits) {
  if (!(digits >= 0.0 && digits < 240000.0)) return "";
  const auto whole = static_cast<long>(digits);
  if (whole / 100 % 100 > 59 || whole % 100 > 59) return "";
  return fmt::format("{:02}:{:02}:{:09.6f}",
                     whole / 10000,
                     whole / 100 % 100,
                     std::fmod(digits, 100.0));
}

// "08.15" as a clock whose point parts hours and minutes.
std::string ClockOfPoints(double digits) {
  const double minutes = std::round(100.0 * digits);
  if (std::isnan(digits) || std::abs(100.0 * digits - minutes) > 1e-6) {
    return "";
  }
  return ClockOfDigits(100.0 * minutes);
}

// Columns of one number each that make a date together, "" where none.
class DateParts {
 public:
  explicit DateParts(const CsvTable& table) : table_(table) {
    constexpr auto kNames =
        std::to_array<Names>({{"year jahr annee anno ano yyyy", ""},
                              {"month monat mois mese mes mm", ""},
                              {"day tag jour giorno dia dd", ""},
                              {"ora hh", "h"},
                              {"mm", "min"},
                              {"ss", "s"}});
    for (const Names& names : kNames) columns_.push_back(Find(names));
  }

  bool are_found() const {
    return columns_[0] && columns_[1] && columns_[2] && FromTo(0, 1980, 2070) &&
           FromTo(1, 1, 12) && FromTo(2, 1, 31);
  }

  CsvColumn Joined() const {
    const bool has_clock = HasClock();
    return AsText(Name(), table_.num_rows, [&](std::size_t row) {
      std::string text = fmt::format("{:04.0f}-{:02.0f}-{:02.0f}",
                                     Value(0, row),
                                     Value(1, row),
                                     Value(2, row));
      if (!has_clock) return text;
      return text + fmt::format(" {:02.0f}:{:02.0f}:{:09.6f}",
                                Value(3, row),
                                Value(4, row),
                                columns_[5] ? Value(5, row) : 0.0);
    });
  }

  std::vector<std::size_t> columns() const {
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < NumUsed(); ++i) {
      if (columns_[i]) used.push_back(*columns_[i]);
    }
    return used;
  }

 private:
  // Of a part: its words, beside those of a unit of time.
  struct Names {
    std::string_view words;
    std::string_view unit;
  };

  std::optional<std::size_t> Find(const Names& names) const {
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      const CsvColumn& column = table_.columns[i];
      const std::vector<std::string> words = WordsOf(column.name);
      if (words.size() != 1 || column.is_text() || !column.exceptions.empty() ||
          IsFound(i)) {
        continue;
      }
      const TimeUnit* const unit = StatedUnit(words[0]);
      if (IsOneOf(words[0], names.words) ||
          (unit != nullptr && unit->name == names.unit)) {
        return i;
      }
    }
    return std::nullopt;
  }

  // "MM" is the month, the next one the minute.
  bool IsFound(std::size_t column) const {
    return std::ranges::count(columns_, std::optional(column)) > 0;
  }

  bool FromTo(std::size_t part, double least, double most) const {
    return All(table_.columns[*columns_[part]], [&](double value) {
      return value >= least && value <= most &&
             (part == 5 || value == std::floor(value));
    });
  }

  bool HasClock() const {
    return columns_[3] && columns_[4] && FromTo(3, 0, 23) && FromTo(4, 0, 59) &&
           (!columns_[5] || FromTo(5, 0, 59.999999));
  }

  std::size_t NumUsed() const { return HasClock() ? columns_.size() : 3; }

  std::string Name() const {
    std::string name;
    for (const std::size_t column : columns()) {
      name += (name.empty() ? "" : " + ") + table_.columns[column].name;
    }
    return name;
  }

  double Value(std::size_t part, std::size_t row) const {
    return table_.columns[*columns_[part]].values[row];
  }

  const CsvTable& table_;
  std::vector<std::optional<std::size_t>> columns_;
};

// By its form; by its name beside a date, or in so many rows that numbers of
// seconds would have some that no clock shows.
bool IsCalledTimeOfDay(const CsvColumn& column, bool has_date) {
  constexpr std::size_t kEnoughRows = 24;
  const bool may_be = has_date || column.values.size() >= kEnoughRows;
  return (may_be && IsCalled(column.name, Word::kTime)) ||
         HasWordOf(column.name, "hhmmss hhmm");
}

// "803" as a clock of hours and minutes.
std::string ClockOfMinutes(double digits) {
  return ClockOfDigits(100.0 * digits);
}

// As below, over more than one hour, and of a clock's minutes many differ: 0 to
// 39 count what they like. So do numbers with a unit.
bool AreClocksOfMinutes(const CsvColumn& column) {
  constexpr std::size_t kEnough = 12;
  if (UnitOfColumn(column.name).quantity == Quantity::kTime) return false;
  std::set<double> minutes;
  std::set<double> hours;
  return All(column,
             [&](double value) {
               minutes.insert(std::fmod(value, 100.0));
               hours.insert(std::floor(value / 100.0));
               return value == std::floor(value) &&
                      !ClockOfMinutes(value).empty();
             }) &&
         minutes.size() >= kEnough && hours.size() > 1;
}

// 60 to 99 never stand in the last digits of a clock, 0 to 59 all do.
bool AreClocksOfDigits(const CsvColumn& column) {
  constexpr double kOneHour = 10000.0;
  return All(column,
             [](double value) { return !ClockOfDigits(value).empty(); }) &&
         std::ranges::any_of(column.values,
                             [](double value) { return value >= kOneHour; });
}

// Parts of an hour have more than 59 hundredths.
bool AreClocksOfPoints(const CsvColumn& column) {
  constexpr std::size_t kEnough = 12;
  std::set<double> minutes;
  return All(column,
             [&](double value) {
               minutes.insert(std::round(100.0 * (value - std::floor(value))));
               return !ClockOfPoints(value).empty();
             }) &&
         minutes.size() >= kEnough;
}

}  // namespace

std::vector<std::size_t> WriteDates(CsvTable* table) {
  bool has_date = std::ranges::any_of(table->columns, HoldsDates);
  for (CsvColumn& column : table->columns) {
    if (column.is_text()) continue;
    const bool is_excel =
        IsCalled(column.name, Word::kDate) &&
        All(column, [](double day) { return AreWholeDays({day}); });
    if (is_excel || AreDatesOfDigits(column)) {
      WriteAs(is_excel ? DateOfExcel : DateOfDigits, &column);
      has_date = true;
    }
  }
  for (CsvColumn& column : table->columns) {
    if (column.is_text() || !IsCalledTimeOfDay(column, has_date)) continue;
    if (AreClocksOfDigits(column)) {
      WriteAs(ClockOfDigits, &column);
    } else if (AreClocksOfMinutes(column)) {
      WriteAs(ClockOfMinutes, &column);
    } else if (has_date && AreClocksOfPoints(column)) {
      WriteAs(ClockOfPoints, &column);
    }
  }
  const DateParts parts(*table);
  if (!parts.are_found()) return {};
  std::vector<std::size_t> used = parts.columns();
  if (CsvColumn joined = parts.Joined(); table->Find(joined.name) < 0) {
    table->columns.push_back(std::move(joined));  // not written yet
  }
  return used;
}

}  // namespace errmap::data
