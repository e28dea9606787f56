#include "data/measurements/clock/clock.h"

#include <algorithm>
#include <cmath>

#include "data/argument_name.h"
#include "data/column_header.h"
#include "data/column_words.h"
#include "data/measurements/clock/date_time.h"
#include "data/measurements/clock/row_columns.h"
#include "data/measurements/clock/text_times.h"
#include "data/measurements/clock/time_units.h"
#include "data/measurements/joined_tables.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

class ClockFinder : private RowColumns {
 public:
  ClockFinder(const CsvTable& table,
              const DatasetSelection& selection,
              const std::vector<Index>& rows)
      : RowColumns(table, selection, rows),
        dates_(ColumnOfDates(table, selection)) {
    UseRowNumbers();
  }

  Clock Find() {
    if (selection_.time == "none" && table_.Find("none") < 0) {
      return std::move(clock_);
    }
    if (!selection_.time.empty()) {
      Take(NamedColumn(selection_.time, ArgumentName("time")), true);
      return std::move(clock_);
    }
    for (std::vector<std::size_t> candidates :
         ColumnsOfTime(table_, selection_, rows_)) {
      if (candidates.size() > 1 && table_.At(candidates[0]).is_text()) {
        TakeLikeliest(&candidates);
      }
      if (candidates.size() > 1) {
        clock_.remarks.push_back(
            "several columns could be the time; name one with " +
            ArgumentName("time"));
        break;
      }
      if (candidates.size() == 1) Take(candidates.front(), false);
      if (clock_.is_found()) break;
    }
    return std::move(clock_);
  }

 private:
  // Of several columns of dates the one that is called a time, else the first.
  void TakeLikeliest(std::vector<std::size_t>* candidates) {
    const auto called =
        std::ranges::find_if(*candidates, [&](std::size_t column) {
          const std::string& name = table_.columns[column].name;
          return IsCalled(name, Word::kTime) || IsCalled(name, Word::kDate);
        });
    const std::size_t taken =
        called == candidates->end() ? candidates->front() : *called;
    for (const std::size_t other : *candidates) {
      if (other == taken) continue;
      clock_.sure = false;
      clock_.alternative = table_.columns[other].name;
    }
    *candidates = {taken};
  }

  void UseRowNumbers() {
    clock_.known.assign(rows_.size(), true);
    clock_.time = RowNumbers();
  }

  // A column that hardly ever has a time is no clock.
  void NoteMissing(std::size_t column, std::size_t row) {
    constexpr std::ptrdiff_t kSeldom = 10;
    const CsvColumn& cells = table_.columns[column];
    const auto missing =
        std::ranges::count_if(cells.exceptions, [&](const auto& cell) {
          return IsMissingNumber(cells.texts[cell.second]);
        });
    if (kSeldom * missing <= std::ssize(rows_)) clock_.lacks = {column, row};
  }

  void Take(std::size_t index, bool named) {
    const CsvColumn& column = table_.columns[index];
    const TextTimes times = ReadTimes(column);
    std::vector<double> values = ValuesOf(column);
    const bool as_numbers = !column.is_text();
    std::vector<bool> known(rows_.size(), true);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!std::isnan(values[i])) continue;
      const std::size_t row = DataRow(i);
      const std::string& text = *column.TextAt(row);
      const auto at = static_cast<std::size_t>(&text - column.texts.data());
      if (IsMissingNumber(text)) {
        if (!MayBeMissing(index, row, named, &clock_.remarks)) {
          NoteMissing(index, row);
          return UseRowNumbers();
        }
        known[i] = false;
      } else if (as_numbers || !times.seconds[at]) {
        PassOver(named,
                 table_.Where(row, column.name) + ": " + QuotedText(text) +
                     " is not a time",
                 "write seconds, or dates and times such as "
                 "2024-03-01T12:00:05, or name another column with " +
                     ArgumentName("time"),
                 &clock_.remarks);
        return UseRowNumbers();
      } else {
        values[i] = *times.seconds[at];
      }
    }
    if (std::ranges::find(known, true) == known.end()) return;
    clock_.column = static_cast<std::ptrdiff_t>(index);
    clock_.lacks.reset();
    clock_.evidence = named        ? Evidence::kUser
                      : as_numbers ? Evidence::kName
                                   : Evidence::kNameAndValues;
    if (as_numbers) {
      if (ArePartsOfDays(column.name, values)) {
        Scale(*FindTimeUnit("days"), 0.0, &values);
      } else {
        ToSeconds(column.name, named, &values);
      }
      clock_.hours_alone = (clock_.unit == "h" && AreHoursOfDays(values)) ||
                           PassMidnight(values);
      if (!clock_.dated && TellsTheHour(values)) AddDates(&values, &known);
    } else {
      clock_.unit = "date";
      clock_.dated = times.all_dates;
      clock_.hours_alone = !times.all_dates && !times.elapsed;
      clock_.origin = clock_.dated    ? "1970"
                      : times.elapsed ? "begin"
                                      : "midnight";
      SayOrder(column, times);
      if (times.elapsed) RefuseMinutesAlone(column, values);
      if (clock_.hours_alone) AddDates(&values, &known);
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      clock_.time[static_cast<Index>(i)] = values[i];
    }
    clock_.known = std::move(known);
    HoldLast(clock_.known, &clock_.time);
  }

  // Minutes and seconds that begin again after the 60th minute, or elsewhere
  // than at their least, as spreadsheets show a clock (59:58.1, 00:03.1; then
  // 17:20.4): how many hours passed, nobody can tell.
  void RefuseMinutesAlone(const CsvColumn& column,
                          const std::vector<double>& values) const {
    constexpr double kHour = 3600.0;
    constexpr double kNearTheEnd = 300.0;
    constexpr double kMinute = 60.0;
    constexpr std::size_t kSeldom = 4;  // more often: rows in no order
    const Pace pace = PaceOf(values);
    if (pace.most >= kHour) return;
    const bool is_full =
        pace.most >= kHour - kNearTheEnd && pace.least <= kNearTheEnd;
    double last_begin = values.front();
    for (std::size_t i = 1; i < values.size(); ++i) {
      if (values[i] < values[i - 1]) {
        last_begin = std::max(last_begin, values[i]);
      }
    }
    if (!is_full && (last_begin - pace.least <= kMinute ||
                     kSeldom * StepsOf(values).back > values.size())) {
      return;
    }
    for (std::size_t i = 1; i < values.size(); ++i) {
      if (!(values[i] < values[i - 1])) continue;
      throw InputError(table_.Where(DataRow(i), column.name) + ": " +
                       QuotedText(table_.CellText(column, DataRow(i))) +
                       " comes after " +
                       QuotedText(table_.CellText(column, DataRow(i - 1))) +
                       ", so the hours are missing; write hours, minutes and "
                       "seconds (08:59:58.1), or leave the clock out with " +
                       ArgumentName("time", "none"));
    }
  }

  void SayOrder(const CsvColumn& column, const TextTimes& times) {
    if (times.order.empty()) return;
    clock_.remarks.push_back("the dates of " + NameInRemark(column.name) +
                             " are read as " + times.order);
  }

  // The names of files tell days apart, and not the time of a next file.
  bool HasDatesBeside() const {
    return dates_ >= 0 && table_.At(dates_).name != kFileColumn;
  }

  // As Excel counts hours beside a column of dates.
  bool ArePartsOfDays(const std::string& name,
                      const std::vector<double>& values) const {
    return StatedUnit(name) == nullptr && HasDatesBeside() &&
           std::ranges::none_of(
               values, [](double part) { return part < 0.0 || part >= 1.0; });
  }

  // Whether seconds may be those of each day: below 86400, and back or far on
  // where the date beside them changes, which what runs through the days is
  // not.
  bool TellsTheHour(const std::vector<double>& values) const {
    if (!HasDatesBeside()) return false;
    const CsvColumn& dates = table_.At(dates_);
    const double pause = kLeapSteps * PaceOf(values).step;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] < 0.0 || values[i] >= kSecondsOfDay) return false;
      const bool same =
          i == 0 || dates.TextAt(DataRow(i)) == dates.TextAt(DataRow(i - 1));
      const double step = same ? 0.0 : values[i] - values[i - 1];
      if (step > 0.0 && step <= pause) return false;
    }
    return true;
  }

  // "7.966" h: below 24, from no 0, and back with each day.
  static bool AreHoursOfDays(const std::vector<double>& values) {
    constexpr double kFirst = 3600.0;
    return StepsOf(values).back > 0 &&
           std::ranges::all_of(values, [](double value) {
             return value >= kFirst && value < kSecondsOfDay;
           });
  }

  // Seconds of the day that begin anew within an hour of midnight.
  static bool PassMidnight(const std::vector<double>& values) {
    constexpr double kHour = 3600.0;
    bool passes = false;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] < 0.0 || values[i] >= kSecondsOfDay) return false;
      passes = passes || (i > 0 && values[i] <= kHour &&
                          values[i - 1] >= kSecondsOfDay - kHour);
    }
    return passes;
  }

  // The days of hours that stand in a column of their own.
  void AddDates(std::vector<double>* values, std::vector<bool>* known) {
    if (dates_ < 0) return;
    const CsvColumn& column = table_.At(dates_);
    const TextTimes dates = ReadTimes(column);
    std::vector<double> days;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const std::string* const text = column.TextAt(DataRow(i));
      const auto place = text == nullptr
                             ? std::optional<double>()
                             : dates.seconds[text - column.texts.data()];
      days.push_back(place.value_or(std::nan("")));
    }
    if (!AddDays(std::move(days), values, known)) return;
    clock_.dated = true;
    clock_.hours_alone = false;
    clock_.origin = "1970";
    SayOrder(column, dates);
  }

  // Rows of the day after their date: it is that of the beginning, and stays
  // where the clock passes midnight, once. None where rows are in no order.
  static std::vector<bool> AfterMidnight(const std::vector<double>& days,
                                         const std::vector<double>& clock) {
    std::vector<bool> after(days.size(), false);
    for (std::size_t i = 1; i < days.size(); ++i) {
      const double back = clock[i - 1] - clock[i];
      const bool is_same = days[i] == days[i - 1];
      const bool passes = is_same && back > kSecondsOfDay / 2.0;
      const bool disorder =
          days[i] < days[i - 1] ||
          (is_same && back > 0.0 && (!passes || after[i - 1]));
      if (disorder) return std::vector<bool>(days.size(), false);
      after[i] = is_same && (passes || after[i - 1]);
    }
    return after;
  }

  // Adds the days (NaN: missing) of another column to times of day. Between
  // rows of one day it is that day; else the time is not known, or without
  // leave to drop rows no day is.
  bool AddDays(std::vector<double> days,
               std::vector<double>* values,
               std::vector<bool>* known) {
    std::vector<double> next(days.size(), std::nan(""));  // from each row on
    for (std::size_t i = days.size(); i-- > 0;) {
      next[i] = !std::isnan(days[i])  ? days[i]
                : i + 1 < days.size() ? next[i + 1]
                                      : std::nan("");
    }
    std::vector<bool> lack(days.size(), false);
    double before = std::nan("");
    for (std::size_t i = 0; i < days.size(); ++i) {
      if (std::isnan(days[i]) && next[i] == before) days[i] = before;
      lack[i] = std::isnan(days[i]);
      if (!lack[i]) before = days[i];
    }
    for (std::size_t i = 0; i < lack.size(); ++i) {
      if (lack[i] && !MayBeMissing(static_cast<std::size_t>(dates_),
                                   DataRow(i),
                                   false,
                                   &clock_.remarks)) {
        NoteMissing(static_cast<std::size_t>(dates_), DataRow(i));
        return false;
      }
    }
    const std::vector<bool> next_day = AfterMidnight(days, *values);
    for (std::size_t i = 0; i < days.size(); ++i) {
      (*values)[i] += days[i] + (next_day[i] ? kSecondsOfDay : 0.0);
      (*known)[i] = (*known)[i] && !lack[i];
    }
    clock_.date_column = dates_;
    return true;
  }

  // That of nearly all logs.
  static bool HasUsualStep(const Pace& pace, const TimeUnit& unit) {
    const double step = pace.step * unit.seconds;
    return step >= 0.5 && step <= 3600.0;
  }

  void ToSeconds(const std::string& name,
                 bool named,
                 std::vector<double>* values) {
    const TimeUnit* unit = StatedUnit(name);
    clock_.origin = "begin";
    if (!selection_.time_unit.empty()) {
      unit = FindTimeUnit(selection_.time_unit);
      if (unit == nullptr) {
        throw InputError(
            ArgumentName("time_unit", selection_.time_unit) +
            ": is not a unit of time; give s, ms, us, ns, min, h or "
            "days");
      }
      const std::optional<Epoch> epoch =
          EpochOf(PaceOf(*values), Named::kNothing);
      Scale(*unit, 0.0, values);
      if (epoch && epoch->unit == unit) TakeEpoch(*epoch);
      return;
    }
    if (std::ranges::none_of(*values, [](double value) {
          return !std::isnan(value) && std::isnan(SecondsOfDigits(value));
        })) {
      for (double& value : *values) value = SecondsOfDigits(value);
      clock_.unit = "YYYYMMDDhhmmss";
      clock_.dated = true;
      clock_.origin = "1970";
      return;
    }
    const Pace pace = PaceOf(*values);
    // "Heure" and "Hora" are hours, or any clock: rows are not hours apart.
    if (unit == FindTimeUnit("h") && IsCalled(name, Word::kTime) &&
        UnitOfColumn(name).symbol.empty() && pace.step >= 1.0) {
      unit = nullptr;
    }
    if (const auto epoch = NamedEpoch(name, pace)) {
      Scale(*epoch->unit, epoch->offset, values);
      TakeEpoch(*epoch);
      clock_.unit = "days";
      return;
    }
    const bool is_date = Says(name, Word::kDate) && AreWholeDays(*values);
    const bool is_time = named || Says(name, Word::kTime) ||
                         Says(name, Word::kDate) || NamesTime(name);
    const std::optional<Epoch> epoch = EpochOf(pace,
                                               is_date   ? Named::kDate
                                               : is_time ? Named::kTime
                                                         : Named::kNothing);
    // Numbers from 1970 in one unit hardly ever are so large in another, but
    // for months in ms; Excel's days are numbers as any.
    const bool fits = unit != nullptr && pace.MayBeIn(*unit);
    const bool elapsed = fits && epoch && HasUsualStep(pace, *unit) &&
                         !HasUsualStep(pace, *epoch->unit) &&
                         pace.most * unit->seconds < 366.0 * kSecondsOfDay;
    if (epoch &&
        (!fits || epoch->unit == unit || !(elapsed || epoch->counts_days()))) {
      clock_.sure = unit == nullptr || !fits || epoch->unit == unit;
      if (!clock_.sure) clock_.alternative = unit->name;
      Scale(*epoch->unit, epoch->offset, values);
      TakeEpoch(*epoch);
      return;
    }
    if (fits) {
      Scale(*unit, 0.0, values);
      return;
    }
    if (unit != nullptr) {  // the name has the last word
      Scale(*unit, 0.0, values);
      clock_.sure = false;
      return;
    }
    std::vector<const TimeUnit*> fitting;
    // As spreadsheets write a time of day: "0.3076389".
    if (pace.least >= 0.0 && pace.most < 1.0 && IsCalled(name, Word::kTime)) {
      fitting.push_back(FindTimeUnit("days"));
    }
    for (const char* likely : {"s", "ms", "us", "min", "h", "days"}) {
      const TimeUnit* candidate = FindTimeUnit(likely);
      if (pace.MayBeIn(*candidate) &&
          std::ranges::count(fitting, candidate) == 0) {
        fitting.push_back(candidate);
      }
    }
    if (fitting.empty()) fitting.push_back(FindTimeUnit("s"));
    Scale(*fitting.front(), 0.0, values);
    clock_.remarks.push_back(
        NameInRemark(name) + " names no unit and is taken for " +
        (fitting.front()->name == "s" ? "seconds"
                                      : std::string(fitting.front()->name)));
    clock_.sure = fitting.size() == 1;
    if (fitting.size() > 1) clock_.alternative = fitting[1]->name;
  }

  void TakeEpoch(const Epoch& epoch) {
    clock_.dated = true;
    clock_.origin = "1970";
    if (epoch.counts_days()) clock_.unit = "Excel days";
  }

  void Scale(const TimeUnit& unit, double offset, std::vector<double>* values) {
    clock_.unit = unit.name;
    for (double& value : *values) value = unit.seconds * value + offset;
    // Days with a fraction are rounded to the ms that they were written from.
    if (unit.seconds < kSecondsOfDay) return;
    for (double& value : *values) value = std::round(1e3 * value) / 1e3;
  }

  std::ptrdiff_t dates_;  // the only column of dates without hours, or -1
  Clock clock_;
};

}  // namespace

bool Clock::DatesRise() const {
  const auto rises_not = [](double before, double now) {
    return !(before < now);
  };
  return dated && std::ranges::count(known, false) == 0 &&
         std::ranges::adjacent_find(time, rises_not) == time.end();
}

Clock FindClock(const CsvTable& table,
                const DatasetSelection& selection,
                const std::vector<Index>& rows) {
  return ClockFinder(table, selection, rows).Find();
}

}  // namespace errmap::data
