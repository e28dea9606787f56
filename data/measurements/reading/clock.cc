#include "data/measurements/reading/clock.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "data/argument_name.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/date_time.h"
#include "data/measurements/reading/column_words.h"
#include "data/measurements/sessions.h"
#include "data/measurements/text_times.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {
namespace {

using Eigen::Index;

constexpr double kSecondsOfDay = 86400.0;

struct TimeUnit {
  std::string_view name;
  double seconds;
};
constexpr auto kTimeUnits = std::to_array<TimeUnit>({{"s", 1.0},
                                                     {"ms", 1e-3},
                                                     {"us", 1e-6},
                                                     {"ns", 1e-9},
                                                     {"min", 60.0},
                                                     {"h", 3600.0},
                                                     {"days", kSecondsOfDay}});

const TimeUnit* FindTimeUnit(std::string_view name) {
  const auto* const found =
      std::ranges::find(kTimeUnits, name, &TimeUnit::name);
  return found == kTimeUnits.end() ? nullptr : found;
}

// What a name says of the unit of its times; null: nothing.
const TimeUnit* StatedUnit(std::string_view column) {
  const Header header = ReadHeader(column);
  if (const TimeUnit* unit = FindTimeUnit(header.unit.symbol)) return unit;
  const std::vector<std::string> words = WordsOf(column);
  const std::string last = words.empty() ? "" : words.back();
  if (last == "d" || last == "day" || last == "days" || last == "tage") {
    return words.size() > 1 ? FindTimeUnit("days") : nullptr;
  }
  for (const std::string& text : {last, header.unit_text}) {
    if (text == "us" || text == "ns") return FindTimeUnit(text);
    if (text == "sec" || text == "seconds" || text == "sek") {
      return FindTimeUnit("s");
    }
  }
  return nullptr;
}

// Steps and span of times as they stand.
struct Pace {
  double least = 0.0;
  double most = 0.0;
  double step = 0.0;  // median of those above 0

  // 0.01 s to a day, under ten years.
  bool MayBeIn(const TimeUnit& unit) const {
    constexpr double kLeastStep = 0.01;
    constexpr double kMostSpan = 3653.0 * kSecondsOfDay;
    return !std::isfinite(step) ||
           (step * unit.seconds >= 0.999 * kLeastStep &&
            step * unit.seconds <= 1.001 * kSecondsOfDay &&
            (most - least) * unit.seconds < kMostSpan);
  }
};

Pace PaceOf(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return {};
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i) {
    steps.push_back(std::abs(values[i] - values[i - 1]));
  }
  // Rows in another order have long steps; sorted, they have their own.
  std::vector<double> sorted = values;
  std::ranges::sort(sorted);
  std::vector<double> in_order;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    in_order.push_back(sorted[i] - sorted[i - 1]);
  }
  const double step =
      std::min(MedianStep(std::move(steps)), MedianStep(std::move(in_order)));
  return {sorted.front(), sorted.back(), step};
}

// Seconds of 20260302080000; NaN where it is no such number.
double SecondsOfDigits(double number) {
  if (!(number >= 19800101000000.0 && number < 20700101000000.0)) {
    return std::nan("");
  }
  const std::string text = CsvNumber(std::floor(number));
  if (text.size() != 14) return std::nan("");
  const auto part = [&](std::size_t at, std::size_t size) {
    return text.substr(at, size);
  };
  const auto parsed =
      ParseDateTime(part(0, 4) + "-" + part(4, 2) + "-" + part(6, 2) + " " +
                    part(8, 2) + ":" + part(10, 2) + ":" + part(12, 2));
  return parsed ? parsed->seconds + number - std::floor(number) : std::nan("");
}

// Numbers that count from 1970 (or are Excel's days) whatever their unit is
// called: the years 1990 to 2060 in each unit do not meet.
struct Epoch {
  const TimeUnit* unit;
  double offset;  // seconds from 1970 to 0
};
std::optional<Epoch> EpochOf(const Pace& pace, bool by_name) {
  constexpr double kFrom = 6.3e8;
  constexpr double kTo = 2.84e9;
  for (const char* name : {"s", "ms", "us", "ns"}) {
    const TimeUnit* unit = FindTimeUnit(name);
    if (pace.least * unit->seconds >= kFrom &&
        pace.most * unit->seconds <= kTo && pace.MayBeIn(*unit)) {
      return Epoch{unit, 0.0};
    }
  }
  // Excel counts days from 30 December 1899.
  constexpr double kDaysTo1970 = 25569.0;
  const TimeUnit* days = FindTimeUnit("days");
  const double from = (pace.least - kDaysTo1970) * kSecondsOfDay;
  const double to = (pace.most - kDaysTo1970) * kSecondsOfDay;
  if (by_name && from >= kFrom && to <= kTo && pace.MayBeIn(*days) &&
      pace.step < 1.0) {
    return Epoch{days, -kDaysTo1970 * kSecondsOfDay};
  }
  return std::nullopt;
}

class ClockFinder {
 public:
  ClockFinder(const CsvTable& table,
              const DatasetSelection& selection,
              const std::vector<Index>& rows)
      : table_(table), selection_(selection), rows_(rows) {
    UseRowNumbers();
  }

  Clock Find() {
    if (selection_.time == "none" && table_.Find("none") < 0) {
      return std::move(clock_);
    }
    if (!selection_.time.empty()) {
      Take(NamedColumn(), true);
      return std::move(clock_);
    }
    for (const auto& candidates : Candidates()) {
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
  void UseRowNumbers() {
    clock_.known.assign(rows_.size(), true);
    clock_.time.resize(std::ssize(rows_));
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      clock_.time[static_cast<Index>(i)] = static_cast<double>(rows_[i]);
    }
  }

  // What is measured tells no time: filters would see the error itself.
  bool IsMeasured(std::size_t column) const {
    const std::string& name = table_.columns[column].name;
    return name == selection_.target || name == selection_.weight;
  }

  std::size_t NamedColumn() const {
    const std::size_t index =
        RequireColumn(table_, selection_.time, ArgumentName("time"));
    if (IsMeasured(index)) {
      throw InputError(PrintablePath(table_.file) + ": column " +
                       QuotedName(table_.columns[index].name) +
                       " is the target or the weight; name another with " +
                       ArgumentName("time"));
    }
    return index;
  }

  // Columns that could be the time, the likeliest first.
  std::vector<std::vector<std::size_t>> Candidates() const {
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
      const Quantity quantity = UnitOfColumn(column.name).quantity;
      const bool fits = quantity == Quantity::kTime ||
                        UnitOfColumn(column.name).symbol.empty();
      if (NamesTime(column.name)) {
        found[StartsWithIgnoringCase(column.name, "time") ? 1 : 2].push_back(i);
      } else if (fits && (Says(column.name, Word::kTime) ||
                          Says(column.name, Word::kDate))) {
        found[4].push_back(i);
      }
    }
    // Hours and what counts on: the dates beside the hours tell more.
    if (found[0].empty() && !found[3].empty() && DateColumn() >= 0) {
      std::swap(found[0], found[3]);
    }
    if (std::ranges::all_of(found, [](const auto& of) { return of.empty(); })) {
      for (std::size_t i = 0; i < table_.columns.size(); ++i) {
        if (IsMeasured(i)) continue;
        if (CountsFrom1970(table_.columns[i])) found[0].push_back(i);
        if (GoesOn(table_.columns[i])) found[1].push_back(i);
      }
    }
    return found;
  }

  // What is in a unit of time and goes on with the rows.
  bool GoesOn(const CsvColumn& column) const {
    if (column.is_text() || !column.exceptions.empty() || rows_.size() < 2 ||
        UnitOfColumn(column.name).quantity != Quantity::kTime) {
      return false;
    }
    const std::vector<double> values = ValuesOf(column);
    std::size_t back = 0;
    std::size_t on = 0;
    for (std::size_t i = 1; i < values.size(); ++i) {
      on += values[i] > values[i - 1] ? 1 : 0;
      back += values[i] < values[i - 1] ? 1 : 0;
    }
    constexpr std::size_t kSeldom = 10;
    return 2 * on > values.size() && kSeldom * back < values.size();
  }

  bool CountsFrom1970(const CsvColumn& column) const {
    constexpr std::size_t kFewest = 4;
    if (column.is_text() || !column.exceptions.empty() ||
        rows_.size() < kFewest || column.values[DataRow(0)] < 6.3e8) {
      return false;
    }
    const std::vector<double> values = ValuesOf(column);
    return !std::isnan(SecondsOfDigits(values[0])) ||
           EpochOf(PaceOf(values), false).has_value();
  }

  // The only column of dates without hours, or -1.
  std::ptrdiff_t DateColumn() const {
    std::ptrdiff_t found = -1;
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      const CsvColumn& column = table_.columns[i];
      if (IsMeasured(i) || !column.is_text()) continue;
      const TextTimes times = ReadTimes(column);
      if (!times.all || !times.any || times.any_hours) continue;
      if (found >= 0) return -1;
      found = static_cast<std::ptrdiff_t>(i);
    }
    return found;
  }

  std::size_t DataRow(std::size_t i) const {
    return static_cast<std::size_t>(rows_[i]);
  }

  std::vector<double> ValuesOf(const CsvColumn& column) const {
    std::vector<double> values;
    values.reserve(rows_.size());
    for (const Index row : rows_) {
      values.push_back(column.values[static_cast<std::size_t>(row)]);
    }
    return values;
  }

  // A column that somebody named must do; another is passed over.
  void PassOver(bool named, const std::string& why, const std::string& remedy) {
    if (named) throw InputError(why + "; " + remedy);
    clock_.remarks.push_back(why + "; the column is passed over");
    UseRowNumbers();
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
      const auto exception = std::ranges::lower_bound(
          column.exceptions, row, {}, [](const auto& cell) {
            return cell.first;
          });
      const std::string& text = column.texts[exception->second];
      if (IsMissingNumber(text)) {
        if (!MayBeMissing(index, row, named)) return;
        known[i] = false;
      } else if (as_numbers || !times.seconds[exception->second]) {
        PassOver(named,
                 table_.Where(row, column.name) + ": " + QuotedText(text) +
                     " is no time",
                 "write seconds, or dates and times such as "
                 "2024-03-01T12:00:05, or name another column with " +
                     ArgumentName("time"));
        return;
      } else {
        values[i] = *times.seconds[exception->second];
      }
    }
    if (std::ranges::find(known, true) == known.end()) return;
    clock_.column = static_cast<std::ptrdiff_t>(index);
    clock_.evidence = named        ? Evidence::kUser
                      : as_numbers ? Evidence::kName
                                   : Evidence::kNameAndValues;
    if (as_numbers) {
      ToSeconds(column.name, named, &values);
    } else {
      clock_.unit = "date";
      clock_.dated = times.all_dates;
      clock_.hours_alone = !times.all_dates;
      clock_.origin = clock_.dated ? "1970" : "midnight";
      clock_.words = times.doubt;
      if (clock_.hours_alone) AddDates(&values);
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      clock_.time[static_cast<Index>(i)] = values[i];
    }
    clock_.known = std::move(known);
    HoldLast();
  }

  // The days of hours that stand in a column of their own.
  void AddDates(std::vector<double>* values) {
    const std::ptrdiff_t at = DateColumn();
    if (at < 0) return;
    const CsvColumn& column = table_.At(at);
    const TextTimes dates = ReadTimes(column);
    std::vector<double> sums = *values;
    auto cell = column.exceptions.begin();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const std::size_t row = DataRow(i);
      while (cell != column.exceptions.end() && cell->first < row) ++cell;
      if (cell == column.exceptions.end() || !dates.seconds[cell->second]) {
        return;
      }
      sums[i] += *dates.seconds[cell->second];
    }
    *values = std::move(sums);
    clock_.date_column = at;
    clock_.dated = true;
    clock_.hours_alone = false;
    clock_.origin = "1970";
    clock_.words = dates.doubt;
  }

  void ToSeconds(const std::string& name,
                 bool named,
                 std::vector<double>* values) {
    const TimeUnit* unit = StatedUnit(name);
    clock_.origin = "begin";
    if (!selection_.time_unit.empty()) {
      unit = FindTimeUnit(selection_.time_unit);
      if (unit == nullptr) {
        throw InputError(ArgumentName("time_unit", selection_.time_unit) +
                         ": is no unit of time; give s, ms, us, ns, min, h or "
                         "days");
      }
      Scale(*unit, 0.0, values);
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
    const std::optional<Epoch> epoch =
        EpochOf(pace,
                named || Says(name, Word::kTime) || Says(name, Word::kDate) ||
                    NamesTime(name));
    if (unit != nullptr && pace.MayBeIn(*unit)) {
      Scale(*unit, 0.0, values);
      if (epoch && epoch->unit == unit) TakeEpoch(*epoch, values);
      return;
    }
    if (epoch) {
      Scale(*epoch->unit, epoch->offset, values);
      TakeEpoch(*epoch, values);
      return;
    }
    if (unit != nullptr) {  // the name has the last word
      Scale(*unit, 0.0, values);
      clock_.sure = false;
      return;
    }
    std::vector<const TimeUnit*> fitting;
    for (const char* likely : {"s", "ms", "us", "min", "h", "days"}) {
      const TimeUnit* candidate = FindTimeUnit(likely);
      if (pace.MayBeIn(*candidate)) fitting.push_back(candidate);
    }
    if (fitting.empty()) fitting.push_back(FindTimeUnit("s"));
    Scale(*fitting.front(), 0.0, values);
    clock_.words = fitting.front()->name == "s"
                       ? ", taken for seconds"
                       : ", taken for " + std::string(fitting.front()->name);
    clock_.sure = fitting.size() == 1;
    if (fitting.size() > 1) clock_.alternative = fitting[1]->name;
  }

  void TakeEpoch(const Epoch& epoch, std::vector<double>* /*values*/) {
    clock_.dated = true;
    clock_.origin = "1970";
    if (epoch.offset != 0.0) clock_.unit = "Excel days";
  }

  void Scale(const TimeUnit& unit, double offset, std::vector<double>* values) {
    clock_.unit = unit.name;
    for (double& value : *values) value = unit.seconds * value + offset;
    // Days with a fraction are rounded to the ms that they were written from.
    if (unit.seconds < kSecondsOfDay) return;
    for (double& value : *values) value = std::round(1e3 * value) / 1e3;
  }

  // Whether a cell of a column may be missing in this row. One of a column that
  // somebody named drops its row, or stops.
  bool MayBeMissing(std::size_t column, std::size_t row, bool named) {
    if (!named) {
      PassOver(
          false,
          table_.Where(row, table_.columns[column].name) + ": no value there",
          "");
      return false;
    }
    if (selection_.missing == MissingPolicy::kError) {
      RefuseMissingCell(table_, {column, ColumnUse::kOther}, row);
    }
    return true;
  }

  // Rows that are not known get the value before them (the first ones that
  // after them), so that steps to and from them are those of the others.
  void HoldLast() {
    const auto first =
        std::ranges::find(clock_.known, true) - clock_.known.begin();
    double last = clock_.time[first];
    for (std::size_t i = 0; i < clock_.known.size(); ++i) {
      double& value = clock_.time[static_cast<Index>(i)];
      if (clock_.known[i]) last = value;
      value = last;
    }
  }

  const CsvTable& table_;
  const DatasetSelection& selection_;
  const std::vector<Index>& rows_;
  Clock clock_;
};

}  // namespace

Clock FindClock(const CsvTable& table,
                const DatasetSelection& selection,
                const std::vector<Index>& rows) {
  return ClockFinder(table, selection, rows).Find();
}

void GoOnOverMidnight(Clock* clock) {
  constexpr double kHour = 3600.0;
  if (!clock->is_found()) return;
  const double step = [&] {
    std::vector<double> steps;
    for (Index i = 1; i < clock->time.size(); ++i) {
      steps.push_back(clock->time[i] - clock->time[i - 1]);
    }
    return MedianStep(std::move(steps));
  }();
  double added = 0.0;
  double last = clock->time.size() > 0 ? clock->time[0] : 0.0;
  for (Index i = 1; i < clock->time.size(); ++i) {
    const double now = clock->time[i];
    const double back = last - now;
    last = now;
    if (clock->hours_alone && back > 0.0) {
      added += kSecondsOfDay;
    } else if (clock->dated && clock->unit == "date" && back > 0.0 &&
               back <= kHour && kHour - back <= kHour / 2.0 + 20.0 * step) {
      added += kHour;
    }
    clock->time[i] += added;
  }
}

}  // namespace errmap::data
