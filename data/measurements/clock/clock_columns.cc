#include <algorithm>
#include <cmath>
#include <string_view>

#include "data/column_header.h"
#include "data/column_words.h"
#include "data/measurements/clock/clock.h"
#include "data/measurements/clock/row_columns.h"
#include "data/measurements/clock/text_times.h"
#include "data/measurements/clock/time_units.h"
#include "data/measurements/column_roles.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {
namespace {

using Eigen::Index;

class ClockColumns : private RowColumns {
 public:
  ClockColumns(const CsvTable& table,
               const DatasetSelection& selection,
               const std::vector<Index>& rows)
      : RowColumns(table, selection, rows),
        dates_(ColumnOfDates(table, selection)) {}

  std::vector<std::vector<std::size_t>> Find() const {
    std::vector<std::vector<std::size_t>> found(6);
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      const CsvColumn& column = table_.columns[i];
      if (IsMeasured(i)) continue;
      if (column.is_text()) {
        const bool named =
            NamesTime(column.name) || Says(column.name, Word::kTime);
        const TextTimes times = ReadTimes(column);
        if (times.all && times.any && times.any_hours) {
          found[times.all_dates ? 0 : 3].push_back(i);
        } else if (named) {
          found[5].push_back(i);  // to be said why not
        }
        continue;
      }
      const bool is_named = NamesTime(column.name);
      if (!(is_named || MayBeTime(column)) || Repeats(i) ||
          IsDuration(column)) {
        continue;
      }
      const bool is_time = StartsWithIgnoringCase(column.name, "time");
      found[is_time ? 1 : is_named ? 2 : 4].push_back(i);
    }
    // When each session was begun, beside the time since then.
    if (found[0].size() == 1 && !found[4].empty() && Stands(found[0][0])) {
      std::swap(found[0], found[4]);
    }
    // Hours and what counts on: the dates beside the hours tell more.
    if (found[0].empty() && !found[3].empty() && dates_ >= 0) {
      std::swap(found[0], found[3]);
    }
    if (std::ranges::all_of(found, [](const auto& of) { return of.empty(); })) {
      for (std::size_t i = 0; i < table_.columns.size(); ++i) {
        const CsvColumn& column = table_.columns[i];
        if (IsMeasured(i)) continue;
        if (CountsFrom1970(column)) found[0].push_back(i);
        if (!GoesOn(column) || IsDuration(column)) continue;
        (IsCalledTime(column.name) ? found[1] : found[2]).push_back(i);
      }
    }
    return found;
  }

 private:
  // Whether a column of text says the same in many rows.
  bool Stands(std::size_t column) const {
    constexpr std::size_t kMany = 10;
    return kMany * table_.columns[column].texts.size() <= rows_.size();
  }

  // Whether the column has the values of an earlier one of that name: scopes
  // write the time before each channel.
  bool Repeats(std::size_t column) const {
    const CsvColumn& later = table_.columns[column];
    return std::any_of(
        table_.columns.begin(),
        table_.columns.begin() + static_cast<std::ptrdiff_t>(column),
        [&](const CsvColumn& earlier) {
          return later.name.starts_with(earlier.name) &&
                 earlier.exceptions.empty() && later.exceptions.empty() &&
                 std::ranges::equal(earlier.values, later.values);
        });
  }

  // Whether the days are known, and within them the column goes back a third as
  // often as on or more, which of rows in no order a clock does, too: but it
  // neither stays, as "Cycle time [s]" does, nor has more in its name.
  bool IsDuration(const CsvColumn& column) const {
    if (dates_ < 0) return false;
    const CsvColumn& dates = table_.At(dates_);
    const std::vector<double> values = ValuesOf(column);
    std::size_t on = 0;
    std::size_t back = 0;
    std::size_t stays = 0;
    for (std::size_t i = 1; i < values.size(); ++i) {
      if (dates.TextAt(DataRow(i)) != dates.TextAt(DataRow(i - 1))) continue;
      on += values[i] > values[i - 1] ? 1 : 0;
      back += values[i] < values[i - 1] ? 1 : 0;
      stays += values[i] == values[i - 1] ? 1 : 0;
    }
    constexpr std::size_t kOften = 3;
    return (stays > 0 || NamesMoreThanTime(column.name)) && back > 1 &&
           kOften * back >= on;
  }

  // "Settling time", and neither "Elapsed time" nor "t".
  static bool NamesMoreThanTime(std::string_view name) {
    return std::ranges::any_of(WordsOf(name), [](const std::string& word) {
      return word.size() > 1 && !IsWord(word, Word::kTime) &&
             !IsWord(word, Word::kDate);
    });
  }

  // Of a name that says a time or a date somewhere: in a unit of time, or by
  // values as a clock has them. "temp data" and "heating time temp" are
  // thermometers, "tempo" and "cas" may be, "elapsed_cycles" is a count.
  bool MayBeTime(const CsvColumn& column) const {
    const Unit unit = UnitOfColumn(column.name);
    const bool says_time = Says(column.name, Word::kTime);
    const bool says_date = Says(column.name, Word::kDate);
    if (!(says_time || says_date)) return false;
    if (unit.quantity == Quantity::kTime) return true;
    if (Says(column.name, Word::kTemperature)) return false;
    if (!unit.symbol.empty() || CountsCycles({column.name, {}})) return false;
    const std::vector<double> values = ValuesOf(column);
    const Pace pace = PaceOf(values);
    const bool are_days = says_date && !AreWholeDays(values) &&
                          EpochOf(pace, Named::kDate).has_value();
    return are_days || CountsFrom1970(column) ||
           (says_time &&
            (StepsOf(values).GoForward(values.size()) ||
             (IsCalled(column.name, Word::kTime) && AreEven(values))));
  }

  // In whatever order.
  static bool AreEven(std::vector<double> values) {
    std::erase_if(values, [](double value) { return std::isnan(value); });
    std::ranges::sort(values);
    constexpr std::ptrdiff_t kNearlyAll = 90;
    return StepEvenly(values, kNearlyAll);
  }

  // A step apart from one another, this percentage of them.
  static bool StepEvenly(const std::vector<double>& values,
                         std::ptrdiff_t percent) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < values.size(); ++i) {
      steps.push_back(values[i] - values[i - 1]);
    }
    const double step = MedianStep(steps);
    const auto even = std::ranges::count_if(steps, [&](double other) {
      return std::abs(other - step) < 0.01 * step;
    });
    return 100 * even >= percent * std::ssize(steps);
  }

  // In a unit of time, or called by one ("ms", "t", "MJD").
  static bool IsCalledTime(std::string_view name) {
    return !StatesTemperature(name) &&
           (UnitOfColumn(name).quantity == Quantity::kTime ||
            StatedUnit(name) != nullptr || EqualsIgnoringCase(name, "t") ||
            NamedDays(name).has_value());
  }

  // What goes on with the rows: in a unit of time most often, else with each
  // row but where it begins anew, in steps that are not all the same, as those
  // of a number of the row are. What costs least is looked at first: most
  // columns are sensors.
  bool GoesOn(const CsvColumn& column) const {
    const bool called = IsCalledTime(column.name);
    if (column.is_text() || !column.exceptions.empty() || rows_.size() < 2 ||
        (HasUnit(column.name) && !called)) {
      return false;
    }
    const std::vector<double> values = ValuesOf(column);
    const Steps steps = StepsOf(values);
    if (called) {
      return GoesForward(steps, values) || AreEven(values) ||
             NamedEpoch(column.name, PaceOf(values));
    }
    constexpr std::size_t kFewest = 24;
    constexpr std::size_t kHardly = 50;
    return values.size() >= kFewest && kHardly * steps.back < values.size() &&
           steps.on + steps.back + 1 == values.size() &&
           !Says(column.name, Word::kTemperature) &&
           !CountsCycles({column.name, {}}) && !IsCalledPosition(column.name) &&
           !(Says(column.name, Word::kDate) && AreWholeDays(values)) &&
           !AreNumbersOfRows(values);
  }

  // Or rows share times, which are no counts then.
  static bool GoesForward(const Steps& steps,
                          const std::vector<double>& values) {
    const auto is_whole = [](double value) {
      return value == std::floor(value);
    };
    return steps.GoForward(values.size()) ||
           (steps.GoForward(steps.on + steps.back + 1) &&
            !std::ranges::all_of(values, is_whole));
  }

  // All steps alike, or whole numbers without pauses.
  static bool AreNumbersOfRows(const std::vector<double>& values) {
    bool even = true;
    bool whole = values[0] == std::floor(values[0]);
    double longest = 0.0;
    for (std::size_t i = 1; i < values.size(); ++i) {
      whole = whole && values[i] == std::floor(values[i]);
      longest = std::max(longest, values[i] - values[i - 1]);
      even = even && (i < 2 || std::abs(values[i] + values[i - 2] -
                                        2.0 * values[i - 1]) < 1e-9);
    }
    if (even || !whole) return even;
    constexpr std::ptrdiff_t kBetweenPauses = 75;
    return longest <= kLeapSteps * PaceOf(values).step ||
           !StepEvenly(values, kBetweenPauses);
  }

  bool CountsFrom1970(const CsvColumn& column) const {
    constexpr std::size_t kFewest = 4;
    if (column.is_text() || !column.exceptions.empty() ||
        rows_.size() < kFewest || column.values[DataRow(0)] < 6.3e8) {
      return false;
    }
    const std::vector<double> values = ValuesOf(column);
    return !std::isnan(SecondsOfDigits(values[0])) ||
           EpochOf(PaceOf(values), Named::kNothing).has_value();
  }

  std::ptrdiff_t dates_;  // the only column of dates without hours, or -1
};

}  // namespace

std::vector<std::vector<std::size_t>> ColumnsOfTime(
    const CsvTable& table,
    const DatasetSelection& selection,
    const std::vector<Index>& rows) {
  return ClockColumns(table, selection, rows).Find();
}

std::ptrdiff_t ColumnOfDates(const CsvTable& table,
                             const DatasetSelection& selection) {
  std::ptrdiff_t found = -1;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const CsvColumn& column = table.columns[i];
    if (column.name == selection.target || column.name == selection.weight ||
        !HoldsDates(column)) {
      continue;
    }
    if (found >= 0) return -1;
    found = static_cast<std::ptrdiff_t>(i);
  }
  return found;
}

}  // namespace errmap::data
