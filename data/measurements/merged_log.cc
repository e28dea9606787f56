#include "data/measurements/merged_log.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/argument_name.h"
#include "data/columns.h"
#include "data/measurements/clock/clock.h"
#include "data/measurements/clock/clock_zone.h"
#include "data/measurements/clock/text_times.h"
#include "data/measurements/clock/time_units.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/reading/reading.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

// Of each row, in whatever order the rows are.
struct Times {
  Eigen::VectorXd time;
  std::vector<bool> known;
  bool dated = false;
  std::vector<std::ptrdiff_t> columns;  // that they are read from
};

Times TimesOf(const CsvTable& table, const DatasetSelection& selection) {
  std::vector<Index> rows = AllRows(table.num_rows);
  Clock clock = FindClock(table, selection, rows);
  if (!clock.is_found()) {
    RefuseUnreadTimes(table);
    ThrowUnusable(table,
                  "no column of times to join " + ArgumentName("with") +
                      " by; name one with " + ArgumentName("time"));
  }
  const Index steps = std::ssize(rows) - 1;
  if (2 * TimesBack(clock.time) > steps) {  // the newest first
    std::ranges::reverse(rows);
    clock = FindClock(table, selection, rows);
  }
  // Rows in another order pass no midnight.
  if (4 * TimesBack(clock.time) <= steps) {
    GoOnOverMidnight(table, rows, &clock);
  }
  Times times{.time = Eigen::VectorXd(std::ssize(rows)),
              .known = std::vector<bool>(rows.size()),
              .dated = clock.dated,
              .columns = {clock.column, clock.date_column}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    times.time[rows[i]] = clock.time[static_cast<Index>(i)];
    times.known[rows[i]] = clock.known[i];
  }
  return times;
}

double OffsetOf(const std::string& text) {
  if (text.empty()) return 0.0;
  const bool is_negative = text.starts_with('-');
  const bool has_sign = is_negative || text.starts_with('+');
  const std::string_view size = std::string_view(text).substr(has_sign ? 1 : 0);
  double number = 0.0;
  if (ParseNumber(size, &number) && number == 0.0) return 0.0;
  const std::optional<double> seconds = ParseInterval(size);
  if (!seconds) {
    throw InputError(ArgumentName("clock_offset", text) +
                     " is not an interval; write \"3s\", \"-2min\" or \"1h\"");
  }
  return is_negative ? -*seconds : *seconds;
}

// The readings of a log in order of time.
class Readings {
 public:
  // `rows`: of the log.
  Readings(const std::vector<Index>& rows,
           const Eigen::VectorXd& time,
           double ahead) {
    for (const Index row : rows) {
      readings_.emplace_back(time[row] - ahead, row);
    }
    std::ranges::sort(readings_);
    Eigen::VectorXd in_order(std::ssize(readings_));
    std::ranges::transform(
        readings_, in_order.begin(), &std::pair<double, Index>::first);
    step_ = MedianStepOf(in_order);
  }

  double step() const { return step_; }

  /// Row of the log for a moment, or -1; whether it is a later one.
  Index RowAt(double time, bool* is_later) const {
    const auto next = std::ranges::upper_bound(
        readings_, time, {}, &std::pair<double, Index>::first);
    *is_later = false;
    if (next != readings_.begin() &&
        time - std::prev(next)->first <= step_ * kSlack) {
      return std::prev(next)->second;
    }
    *is_later = true;
    const bool is_near =
        next != readings_.end() && next->first - time <= step_ * kSlack;
    return is_near ? next->second : -1;
  }

 private:
  // Clocks are written to a second or so.
  static constexpr double kSlack = 1.05;

  std::vector<std::pair<double, Index>> readings_;
  double step_ = 0.0;
};

// A log may write its decimals another way than the table, but only one.
bool MixesMarks(const CsvTable& log) {
  const auto any = [&](std::ptrdiff_t CsvColumn::*first) {
    return std::ranges::any_of(
        log.columns, [&](const CsvColumn& c) { return c.*first >= 0; });
  };
  return any(&CsvColumn::first_decimal_comma) &&
         any(&CsvColumn::first_decimal_point);
}

void ForgetMarks(CsvColumn* column) {
  column->first_decimal_comma = column->first_decimal_point = -1;
}

// What was found for the rows of a table, at worst.
struct Joined {
  double step = 0.0;  // s
  std::size_t num_later = 0;
  std::size_t num_without = 0;
  std::vector<std::string> names;
};

// The row of the log for each of the table; -1: none.
std::vector<Index> RowsOf(const Readings& readings,
                          const Times& times,
                          Joined* joined) {
  std::vector<Index> rows;
  std::size_t num_later = 0;
  for (const double at : times.time) {
    bool is_later = false;
    rows.push_back(readings.RowAt(at, &is_later));
    num_later += rows.back() >= 0 && is_later ? 1 : 0;
  }
  const auto num_without =
      static_cast<std::size_t>(std::ranges::count(rows, -1));
  joined->step = std::max(joined->step, readings.step());
  joined->num_later = std::max(joined->num_later, num_later);
  joined->num_without = std::max(joined->num_without, num_without);
  return rows;
}

std::string TextOf(const Joined& joined, std::size_t num_rows) {
  return JoinWords(joined.names, ", ") +
         " joined by time: the last reading of up to " +
         CsvNumber(joined.step) + " s before, for " +
         std::to_string(joined.num_later) + " of " + std::to_string(num_rows) +
         " rows the next one" +
         (joined.num_without == 0
              ? std::string()
              : "; " + std::to_string(joined.num_without) + " rows have none");
}

// One clock names its zone, and the other does not. What fits are whole hours
// at which each row has a reading.
[[noreturn]] void AskForOffset(const CsvTable& log,
                               const Times& log_times,
                               bool log_is_zoned,
                               const CsvTable& table,
                               const Times& times) {
  constexpr int kMostHours = 14;
  constexpr std::size_t kMostAnswers = 4;
  const Readings readings(AllRows(log.num_rows), log_times.time, 0.0);
  const auto has_readings = [&](double ahead) {
    return std::ranges::all_of(times.time, [&](double at) {
      bool is_later = false;
      return readings.RowAt(at + ahead, &is_later) >= 0;
    });
  };
  Reading::Question question{
      .topic = "time",
      .question = "the times of " +
                  PrintablePath(log_is_zoned ? log.file : table.file) +
                  " have a time zone, those of " +
                  PrintablePath(log_is_zoned ? table.file : log.file) +
                  " have none; by how much is the clock of " +
                  PrintablePath(log.file) + " ahead?"};
  const auto answer = [&](int hours) {
    const std::string text = hours == 0 ? "0" : std::to_string(hours) + "h";
    question.answers.push_back(
        {.option = ArgumentName("clock_offset", text),
         .means = hours == 0 ? "both clocks show the same time"
                             : "it shows " + std::to_string(std::abs(hours)) +
                                   " h " + (hours < 0 ? "less" : "more")});
  };
  std::size_t fits = 0;
  for (int i = 0; i <= 2 * kMostHours; ++i) {
    const int hours = (i % 2 == 0 ? -1 : 1) * ((i + 1) / 2);
    if (!has_readings(3600.0 * hours)) continue;
    if (++fits <= kMostAnswers) answer(hours);
  }
  if (fits > kMostAnswers) question.question += " Other hours fit, too.";
  if (question.answers.empty()) answer(0);
  throw OpenQuestion(PrintablePath(log.file), std::move(question));
}

}  // namespace

void MergeLog(const CsvTable& log,
              const DatasetSelection& selection,
              CsvTable* table) {
  DatasetSelection of_log;
  if (log.Find(selection.time) >= 0) of_log.time = selection.time;
  const Times times = TimesOf(*table, selection);
  const Times log_times = TimesOf(log, of_log);
  if (times.dated != log_times.dated) {
    ThrowUnusable(log,
                  std::string(log_times.dated ? "has" : "lacks") +
                      " dates with its times, other than " +
                      PrintablePath(table->file) +
                      "; give both the same clock");
  }
  double ahead = OffsetOf(selection.clock_offset);
  const auto zone = SecondsAheadOfUtc(*table, times.columns);
  const auto log_zone = SecondsAheadOfUtc(log, log_times.columns);
  if (zone && log_zone) {
    ahead += *log_zone - *zone;
  } else if ((zone || log_zone) && selection.clock_offset.empty()) {
    AskForOffset(log, log_times, log_zone.has_value(), *table, times);
  }
  const bool mixes_marks = MixesMarks(log);
  Joined joined;
  for (const LogPart& part :
       PartsOfLog(log, log_times.time, log_times.known, log_times.columns)) {
    const Readings readings(part.rows, log_times.time, ahead);
    const std::vector<Index> rows = RowsOf(readings, times, &joined);
    for (const auto& [index, name] : part.columns) {
      if (table->Find(name) >= 0) continue;
      CsvColumn column = TakeRows(log.columns[index], rows);
      column.name = name;
      if (!mixes_marks) ForgetMarks(&column);
      table->columns.push_back(std::move(column));
      joined.names.push_back(QuotedName(name));
    }
  }
  if (joined.num_without == table->num_rows) {
    ThrowUnusable(log,
                  "no reading within a step of the times of " +
                      PrintablePath(table->file) + "; set its clock with " +
                      ArgumentName("clock_offset"));
  }
  if (joined.names.empty()) {
    ThrowUnusable(log,
                  "no column of readings that " + PrintablePath(table->file) +
                      " lacks; a log has times and a column for each sensor");
  }
  table->remarks.insert(
      table->remarks.end(), log.remarks.begin(), log.remarks.end());
  table->remarks.push_back(PrintablePath(log.file) + ": " +
                           TextOf(joined, table->num_rows));
}

}  // namespace errmap::data
