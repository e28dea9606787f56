#include "data/measurements/sessions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "data/argument_name.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/joined_tables.h"
#include "data/measurements/text_times.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

// Seconds per unit of a column of times; nothing where it names no such unit.
std::optional<double> SecondsPerUnit(std::string_view column) {
  const std::string unit = UnitOfColumn(column).symbol;
  if (unit == "s") return 1.0;
  if (unit == "ms") return 1e-3;
  if (unit == "min") return 60.0;
  if (unit == "h") return 3600.0;
  return std::nullopt;
}

std::string Counted(Index count, const std::string& what) {
  return count == 1 ? "one " + what : std::to_string(count) + " " + what + "s";
}

class SessionFinder {
 public:
  SessionFinder(const CsvTable& table,
                const DatasetSelection& selection,
                const std::vector<Index>& rows)
      : table_(table), selection_(selection), rows_(rows) {
    found_.known.assign(rows.size(), true);
  }

  FoundSessions Find() {
    ChooseTime();
    ChooseSessions();
    if (found_.sessions.column.empty()) {
      CutSessions();
    } else {
      RefuseTimeGoingBack();
    }
    // Where nothing tells, there is nothing to say.
    if (found_.time_column >= 0 || !found_.sessions.column.empty()) {
      found_.remarks.push_back(SessionsText() + "; " + TimeText());
    }
    return std::move(found_);
  }

 private:
  const CsvColumn& TimeColumn() const { return table_.At(found_.time_column); }
  std::size_t DataRow(std::size_t i) const {
    return static_cast<std::size_t>(rows_[i]);
  }

  // What is measured tells no time: filters would see the error itself.
  bool IsMeasured(std::size_t column) const {
    const std::string& name = table_.columns[column].name;
    return name == selection_.target || name == selection_.weight;
  }

  std::size_t NamedColumn(const std::string& name,
                          const std::string& argument) const {
    const std::size_t index = RequireColumn(table_, name, argument);
    if (IsMeasured(index)) {
      throw InputError(PrintablePath(table_.file) + ": column " +
                       QuotedName(table_.columns[index].name) +
                       " is the target or the weight; name another with " +
                       argument);
    }
    return index;
  }

  // Those that `wanted` wants of what is not measured.
  template <typename Wanted>
  std::vector<std::size_t> ColumnsOf(const Wanted& wanted) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      if (!IsMeasured(i) && wanted(table_.columns[i])) found.push_back(i);
    }
    return found;
  }

  bool IsNone(const std::string& name) const {
    return name == "none" && table_.Find(name) < 0;
  }

  // A column that somebody named must do; another is passed over.
  void PassOver(bool named, const std::string& why, const std::string& remedy) {
    if (named) throw InputError(why + "; " + remedy);
    found_.remarks.push_back(why + "; the column is passed over");
  }

  // ---- Time.

  void ChooseTime() {
    UseRowNumbers();
    if (IsNone(selection_.time)) return;
    const bool named = !selection_.time.empty();
    std::vector<std::size_t> candidates;
    if (named) {
      candidates.push_back(NamedColumn(selection_.time, ArgumentName("time")));
    } else {
      for (const char* word : kTimeWords) {
        candidates = ColumnsOf([&](const CsvColumn& column) {
          return StartsWithIgnoringCase(column.name, word);
        });
        if (!candidates.empty()) break;
      }
      if (candidates.empty()) {
        candidates = ColumnsOf([](const CsvColumn& column) {
          const TextTimes times = ReadTimes(column);
          return column.is_text() && times.all && times.any_hours;
        });
      }
    }
    if (candidates.size() == 1) {
      TakeTime(candidates.front(), named);
    } else if (candidates.size() > 1) {
      found_.remarks.push_back(
          "several columns could be the time; name one with " +
          ArgumentName("time"));
    }
  }

  void UseRowNumbers() {
    found_.time_column = -1;
    found_.dated = false;
    found_.time_unit = "rows";
    found_.time.resize(static_cast<Index>(rows_.size()));
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      found_.time[static_cast<Index>(i)] = static_cast<double>(rows_[i]);
    }
  }

  void TakeTime(std::size_t index, bool named) {
    const CsvColumn& column = table_.columns[index];
    const double factor = SecondsPerUnit(column.name).value_or(1.0);
    // Of each text once: a column of dates has few or many.
    const TextTimes times = ReadTimes(column);
    const bool as_numbers = !column.is_text();
    Eigen::VectorXd time(static_cast<Index>(rows_.size()));
    std::vector<bool> known = found_.known;
    auto exception = column.exceptions.begin();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const std::size_t row = DataRow(i);
      double& at = time[static_cast<Index>(i)];
      at = factor * column.values[row];
      if (!std::isnan(at)) continue;
      while (exception->first < row) ++exception;
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
        at = *times.seconds[exception->second];
      }
    }
    if (!HoldLast(known, &time)) return;
    order_of_dates_ = times.doubt;
    found_.dated = column.is_text() && times.all_dates;
    hours_alone_ = column.is_text() && !times.all_dates;
    found_.time_column = static_cast<std::ptrdiff_t>(index);
    found_.time_unit = "s";
    found_.time = std::move(time);
    found_.known = std::move(known);
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
  template <typename Values>
  static bool HoldLast(const std::vector<bool>& known, Values* values) {
    const auto first = std::ranges::find(known, true) - known.begin();
    if (first == static_cast<std::ptrdiff_t>(known.size())) return false;
    auto last = (*values)[static_cast<Index>(first)];
    for (std::size_t i = 0; i < known.size(); ++i) {
      auto& value = (*values)[static_cast<Index>(i)];
      if (known[i]) last = value;
      value = last;
    }
    return true;
  }

  // ---- Sessions.

  void ChooseSessions() {
    if (IsNone(selection_.session)) return;
    if (!selection_.session.empty()) {
      TakeSessions(NamedColumn(selection_.session, ArgumentName("session")),
                   true);
      return;
    }
    if (const std::ptrdiff_t file = table_.Find(kFileColumn);
        file >= 0 && table_.parts.size() > 1) {
      TakeSessions(static_cast<std::size_t>(file), false);
      return;
    }
    for (const char* name : kSessionColumns) {
      for (std::size_t i = 0; i < table_.columns.size(); ++i) {
        if (!EqualsIgnoringCase(table_.columns[i].name, name) ||
            IsMeasured(i)) {
          continue;
        }
        if (TakeSessions(i, false)) return;
      }
    }
    // A column of dates tells the days where the time does not.
    if (found_.time_column >= 0 && !hours_alone_) return;
    const auto dates = ColumnsOf([&](const CsvColumn& column) {
      const TextTimes times = ReadTimes(column);
      return column.is_text() && times.all && times.any && !times.any_hours;
    });
    if (dates.size() == 1) TakeSessions(dates.front(), false);
  }

  bool TakeSessions(std::size_t index, bool named) {
    const CsvColumn& column = table_.columns[index];
    std::vector<Index> rows_known;
    std::vector<bool> here(rows_.size(), true);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const std::size_t row = DataRow(i);
      if (std::isnan(column.values[row]) &&
          IsMissingText(table_.CellText(column, row))) {
        if (!MayBeMissing(index, row, named)) return false;
        here[i] = false;
      } else {
        rows_known.push_back(rows_[i]);
      }
    }
    Grouping sessions = GroupByColumn(table_, column.name, rows_known);
    // Every row by itself: a number of the row, not of a run.
    if (!named && sessions.labels.size() > 1 &&
        sessions.labels.size() == rows_known.size()) {
      PassOver(false,
               "column " + QuotedName(column.name) + " has " +
                   std::to_string(sessions.labels.size()) + " values in " +
                   Counted(static_cast<Index>(rows_known.size()), "row") +
                   ", which are no sessions",
               "");
      return false;
    }
    std::vector<Index> codes(rows_.size());
    auto code = sessions.codes.begin();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (here[i]) codes[i] = *code++;
      found_.known[i] = found_.known[i] && here[i];
    }
    auto held = Eigen::Map<Eigen::Array<Index, Eigen::Dynamic, 1>>(
        codes.data(), static_cast<Index>(codes.size()));
    if (!HoldLast(here, &held)) {
      throw InputError(PrintablePath(table_.file) + ": column " +
                       QuotedName(column.name) +
                       " names no session in any row; name another with " +
                       ArgumentName("session"));
    }
    sessions.codes = std::move(codes);
    found_.sessions = std::move(sessions);
    return true;
  }

  void RefuseTimeGoingBack() const {
    if (found_.time_column < 0) return;
    std::vector<double> last(found_.sessions.labels.size(), -INFINITY);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!found_.known[i]) continue;
      const auto session = static_cast<std::size_t>(found_.sessions.codes[i]);
      const double now = found_.time[static_cast<Index>(i)];
      if (now >= last[session]) {
        last[session] = now;
        continue;
      }
      throw InputError(table_.Where(DataRow(i), TimeColumn().name) +
                       ": time goes back by " + CsvNumber(last[session] - now) +
                       " s within " + QuotedName(found_.sessions.column) + " " +
                       QuotedText(found_.sessions.labels[session]) +
                       "; sort its rows by time, name the sessions with " +
                       ArgumentName("session") +
                       ", or go by the numbers of the rows with " +
                       ArgumentName("time", "none"));
    }
  }

  // Sessions begin anew where time does, or after a break.
  void CutSessions() {
    const auto n = static_cast<Index>(rows_.size());
    std::vector<double> steps;
    Index num_back = 0;
    for (Index i = 1; i < n; ++i) {
      const double step = found_.time[i] - found_.time[i - 1];
      steps.push_back(step);
      num_back += step < 0.0 ? 1 : 0;
    }
    // Runs of fewer than four rows are no sessions but disorder.
    constexpr Index kFewestRows = 4;
    if (num_back * kFewestRows > n) {
      PassOver(!selection_.time.empty(),
               PrintablePath(table_.file) + ": " +
                   QuotedName(TimeColumn().name) + " goes back at " +
                   std::to_string(num_back) + " of " + std::to_string(n - 1) +
                   " steps, so the rows are not in order of time",
               "sort them, or name the column of sessions with " +
                   ArgumentName("session"));
      UseRowNumbers();
    }
    const double leap = found_.time_column >= 0
                            ? kLeapSteps * MedianStep(std::move(steps))
                            : INFINITY;
    Index session = 0;
    for (Index i = 0; i < n; ++i) {
      if (i > 0) {
        const double step = found_.time[i] - found_.time[i - 1];
        if (step < 0.0 || step > leap) {
          ++session;
          if (first_cut_ < 0) first_cut_ = rows_[static_cast<std::size_t>(i)];
        }
      }
      found_.sessions.codes.push_back(session);
    }
    for (Index i = 0; i <= session; ++i) {
      found_.sessions.labels.push_back(std::to_string(i + 1));
    }
  }

  // ---- Words.

  std::string SessionsText() const {
    const auto count = static_cast<Index>(found_.sessions.labels.size());
    std::string text = Counted(count, "session");
    if (!found_.sessions.column.empty()) {
      text += " by " + QuotedName(found_.sessions.column);
    } else if (count > 1) {
      text += ", cut where " + QuotedName(TimeColumn().name) +
              " goes back or leaps (first at data row " +
              std::to_string(first_cut_) + ")";
    } else {
      text += std::string(" (no column ") + kSessionColumnsText +
              ", no break in time)";
    }
    return text;
  }

  std::string TimeText() const {
    if (found_.time_column < 0) return "time is the number of the row";
    const std::string& name = TimeColumn().name;
    const bool assumed = !TimeColumn().is_text() && !SecondsPerUnit(name);
    return "time by " + QuotedName(name) +
           (assumed ? ", taken for seconds" : order_of_dates_);
  }

  const CsvTable& table_;
  const DatasetSelection& selection_;
  const std::vector<Index>& rows_;
  FoundSessions found_;
  Index first_cut_ = -1;        // data row
  bool hours_alone_ = false;    // the time has no date
  std::string order_of_dates_;  // words on it where it is in doubt
};

}  // namespace

double MedianStep(std::vector<double> steps) {
  std::erase_if(steps, [](double step) { return !(step > 0.0); });
  if (steps.empty()) return INFINITY;
  const auto middle =
      steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
  std::ranges::nth_element(steps, middle);
  return *middle;
}

std::vector<Index> FirstRows(const Grouping& sessions,
                             const Eigen::MatrixXd& input_values) {
  constexpr Index kNone = -1;
  std::vector<Index> first(sessions.labels.size(), kNone);
  std::vector<Index> complete(sessions.labels.size(), kNone);
  for (std::size_t i = 0; i < sessions.codes.size(); ++i) {
    const auto session = static_cast<std::size_t>(sessions.codes[i]);
    const auto row = static_cast<Index>(i);
    if (first[session] == kNone) first[session] = row;
    if (complete[session] == kNone && input_values.row(row).allFinite()) {
      complete[session] = row;
    }
  }
  for (std::size_t session = 0; session < first.size(); ++session) {
    if (complete[session] != kNone) first[session] = complete[session];
  }
  return first;
}

bool NamesTime(std::string_view name) {
  return std::ranges::any_of(kTimeWords, [&](const char* word) {
    return StartsWithIgnoringCase(name, word);
  });
}

FoundSessions FindSessions(const CsvTable& table,
                           const DatasetSelection& selection,
                           const std::vector<Index>& rows) {
  return SessionFinder(table, selection, rows).Find();
}

}  // namespace errmap::data
