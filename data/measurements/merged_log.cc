#include "data/measurements/merged_log.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "data/argument_name.h"
#include "data/columns.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/sessions.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

FoundSessions TimesOf(const CsvTable& table,
                      const DatasetSelection& selection) {
  FoundSessions found = FindSessions(table, selection, AllRows(table.num_rows));
  if (found.time_column < 0) {
    ThrowUnusable(table,
                  "no column of times to join " + ArgumentName("with") +
                      " by; name one with " + ArgumentName("time"));
  }
  return found;
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
                     " is no interval; write \"3s\", \"-2min\" or \"1h\"");
  }
  return is_negative ? -*seconds : *seconds;
}

// The readings of a log in order of time.
class Readings {
 public:
  Readings(const FoundSessions& times, double ahead) {
    for (Index row = 0; row < times.time.size(); ++row) {
      if (!times.known[static_cast<std::size_t>(row)]) continue;
      readings_.emplace_back(times.time[row] - ahead, row);
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

}  // namespace

void MergeLog(const CsvTable& log,
              const DatasetSelection& selection,
              CsvTable* table) {
  DatasetSelection of_log;
  if (log.Find(selection.time) >= 0) of_log.time = selection.time;
  const FoundSessions times = TimesOf(*table, selection);
  const FoundSessions log_times = TimesOf(log, of_log);
  if (times.dated != log_times.dated) {
    ThrowUnusable(log,
                  std::string(log_times.dated ? "has" : "lacks") +
                      " dates with its times, other than " +
                      PrintablePath(table->file) +
                      "; give both the same clock");
  }
  const Readings readings(log_times, OffsetOf(selection.clock_offset));
  std::vector<Index> rows(table->num_rows);
  std::size_t num_later = 0;
  std::size_t num_without = 0;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    bool is_later = false;
    rows[row] = readings.RowAt(times.time[static_cast<Index>(row)], &is_later);
    num_without += rows[row] < 0 ? 1 : 0;
    num_later += rows[row] >= 0 && is_later ? 1 : 0;
  }
  if (num_without == rows.size()) {
    ThrowUnusable(log,
                  "no reading within a step of the times of " +
                      PrintablePath(table->file) + "; set its clock with " +
                      ArgumentName("clock_offset"));
  }
  std::vector<std::string> names;
  const bool mixes_marks = MixesMarks(log);
  const std::string& time = log.At(log_times.time_column).name;
  for (const CsvColumn& column : log.columns) {
    if (column.name == time || table->Find(column.name) >= 0) continue;
    names.push_back(QuotedName(column.name));
    table->columns.push_back(TakeRows(column, rows));
    if (!mixes_marks) ForgetMarks(&table->columns.back());
  }
  table->remarks.insert(
      table->remarks.end(), log.remarks.begin(), log.remarks.end());
  table->remarks.push_back(
      PrintablePath(log.file) + ": " + JoinWords(names, ", ") +
      " joined by time: the last reading of up to " +
      CsvNumber(readings.step()) + " s before, for " +
      std::to_string(num_later) + " of " + std::to_string(rows.size()) +
      " rows the next one" +
      (num_without == 0
           ? std::string()
           : "; " + std::to_string(num_without) + " rows have none"));
}

}  // namespace errmap::data
