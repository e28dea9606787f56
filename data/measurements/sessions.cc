#include "data/measurements/sessions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "data/argument_name.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/joined_tables.h"
#include "data/measurements/reading/column_words.h"
#include "data/measurements/text_times.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

constexpr double kDaySeconds = 86400.0;

std::string Counted(Index count, const std::string& what) {
  return count == 1 ? "one " + what : std::to_string(count) + " " + what + "s";
}

class SessionFinder {
 public:
  SessionFinder(const CsvTable& table,
                const DatasetSelection& selection,
                const std::vector<Index>& rows,
                SessionClues clues)
      : table_(table),
        selection_(selection),
        rows_(rows),
        clock_(std::move(clues.clock)),
        nights_(clues.nights),
        passes_(std::move(clues.passes)),
        cycle_(clues.cycle) {
    found_.ordered = clues.ordered;
  }

  FoundSessions Find() {
    TakeClock();
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

  void TakeClock() {
    found_.remarks = clock_.remarks;
    found_.known = clock_.known;
    found_.time = clock_.time;
    found_.time_column = clock_.column;
    found_.date_column = clock_.date_column;
    found_.dated = clock_.dated;
    found_.time_unit = clock_.is_found() ? "s" : "rows";
  }

  void UseRowNumbers() {
    found_.time_column = -1;
    found_.dated = false;
    found_.time_unit = "rows";
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      found_.time[static_cast<Index>(i)] = static_cast<double>(rows_[i]);
    }
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

  // The columns that are called so, the likeliest first.
  std::vector<std::size_t> CalledSessions() const {
    std::vector<std::size_t> found;
    const auto add = [&](const auto& called) {
      for (const std::size_t i : ColumnsOf(called)) {
        if (std::ranges::find(found, i) == found.end()) found.push_back(i);
      }
    };
    for (const char* name : kSessionColumns) {
      add([&](const CsvColumn& column) {
        return EqualsIgnoringCase(column.name, name);
      });
    }
    for (const Word word : {Word::kSession, Word::kRun}) {
      add([&](const CsvColumn& column) { return IsCalled(column.name, word); });
    }
    return found;
  }

  void ChooseSessions() {
    if (IsNone(selection_.session)) return;
    if (!selection_.session.empty()) {
      TakeSessions(NamedColumn(selection_.session, ArgumentName("session")),
                   true);
      found_.evidence = Evidence::kUser;
      return;
    }
    if (const std::ptrdiff_t file = table_.Find(kFileColumn);
        file >= 0 && table_.parts.size() > 1) {
      if (ClockGoesOnOverFiles()) return;
      TakeSessions(static_cast<std::size_t>(file), false);
      found_.by = "file";
      return;
    }
    for (const std::size_t i : CalledSessions()) {
      if (!TakeSessions(i, false)) continue;
      const std::string why = WhyNoSessions(i);
      if (why.empty()) return;
      found_.remarks.push_back("column " + QuotedName(table_.columns[i].name) +
                               " " + why);
      found_.sessions = {};
    }
    // A column of dates tells the days where the time does not.
    if (found_.time_column >= 0 && !clock_.hours_alone) return;
    const auto dates = ColumnsOf([&](const CsvColumn& column) {
      const TextTimes times = ReadTimes(column);
      return column.is_text() && times.all && times.any && !times.any_hours;
    });
    if (dates.size() == 1 && TakeSessions(dates.front(), false)) {
      found_.by = "dates";
    }
  }

  // Whether one clock runs through all of several files, so that its pauses
  // tell the sessions and not how the rows were saved.
  bool ClockGoesOnOverFiles() const {
    if (!clock_.is_found()) return false;
    std::set<Index> firsts;
    for (const auto& part : table_.parts) {
      firsts.insert(static_cast<Index>(part.first));
    }
    double within = 0.0;
    double between = 0.0;
    for (Index i = 1; i < found_.time.size(); ++i) {
      const double step = found_.time[i] - found_.time[i - 1];
      if (step < 0.0) return false;
      const bool is_first = firsts.contains(rows_[static_cast<std::size_t>(i)]);
      double& longest = is_first ? between : within;
      longest = std::max(longest, step);
    }
    constexpr double kOtherOrder = 3.0;
    return std::isfinite(nights_.gap) || between < kOtherOrder * within;
  }

  // Why the sessions of a column that is called so are none; "" where they are.
  std::string WhyNoSessions(std::size_t index) const {
    const std::vector<Index>& codes = found_.sessions.codes;
    const CsvColumn& column = table_.columns[index];
    if (found_.sessions.labels.size() < 2) return "";
    if (Says(column.name, Word::kRun) && !passes_.empty() &&
        IsPassOfEach(codes)) {
      return "numbers passes along the axis, which are no sessions";
    }
    if (!found_.dated || column.name == kFileColumn) return "";
    // A shift goes on over midnight.
    bool any = false;
    for (std::size_t i = 1; i < codes.size(); ++i) {
      if (codes[i] == codes[i - 1]) continue;
      const double now = found_.time[static_cast<Index>(i)];
      const double before = found_.time[static_cast<Index>(i) - 1];
      if (std::floor(now / kDaySeconds) == std::floor(before / kDaySeconds)) {
        return "";  // not the days of the calendar
      }
      constexpr double kShortestNight = 3.5 * 3600.0;
      any = any || (now >= before &&
                    now - before <= std::min(nights_.gap, kShortestNight));
    }
    return any ? "changes at midnight during a run; sessions are "
                 "parted by " +
                     QuotedName(TimeColumn().name)
               : "";
  }

  bool IsPassOfEach(const std::vector<Index>& codes) const {
    std::set<std::pair<Index, Index>> pairs;
    std::set<Index> passes;
    for (std::size_t i = 0; i < codes.size(); ++i) {
      pairs.emplace(codes[i], passes_[i]);
      passes.insert(passes_[i]);
    }
    return passes.size() >= 3 && pairs.size() <= passes.size() * 11 / 10 &&
           found_.sessions.labels.size() * 10 >= passes.size() * 9;
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
    found_.by = "column";
    found_.evidence = Evidence::kName;
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

  // Sessions begin anew where time does, or after a night.
  void CutSessions() {
    const auto n = static_cast<Index>(rows_.size());
    Index num_back = 0;
    for (Index i = 1; i < n; ++i) {
      num_back += found_.time[i] < found_.time[i - 1] ? 1 : 0;
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
    CutWhere([&](std::size_t i) {
      const double step = found_.time[static_cast<Index>(i)] -
                          found_.time[static_cast<Index>(i) - 1];
      return found_.time_column >= 0 && (step < 0.0 || step > nights_.gap);
    });
    found_.by = found_.sessions.labels.size() < 2 ? "one"
                : num_back > 0                    ? "clock"
                                                  : "nights";
    found_.gap = nights_.gap;
    found_.evidence =
        selection_.gap.empty() ? Evidence::kValues : Evidence::kUser;
    if (found_.by != "one" || !CountsAnew()) return;
    CutWhere(
        [&](std::size_t i) { return CellOfCycle(i) < CellOfCycle(i - 1); });
    found_.by = "counter";
  }

  template <typename Begins>
  void CutWhere(const Begins& begins) {
    found_.sessions = {};
    Index session = 0;
    first_cut_ = -1;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (i > 0 && begins(i)) {
        ++session;
        if (first_cut_ < 0) first_cut_ = rows_[i];
      }
      found_.sessions.codes.push_back(session);
    }
    for (Index i = 0; i <= session; ++i) {
      found_.sessions.labels.push_back(std::to_string(i + 1));
    }
  }

  double CellOfCycle(std::size_t i) const {
    return table_.At(cycle_).values[DataRow(i)];
  }

  // Whether cycles count from the first one again, some rows each.
  bool CountsAnew() const {
    if (cycle_ < 0 || !found_.ordered || table_.At(cycle_).is_text() ||
        !table_.At(cycle_).exceptions.empty()) {
      return false;
    }
    std::size_t runs = 1;
    bool anew = false;
    for (std::size_t i = 1; i < rows_.size(); ++i) {
      const double step = CellOfCycle(i) - CellOfCycle(i - 1);
      runs += step != 0.0 ? 1 : 0;
      if (!(step < 0.0)) continue;
      if (CellOfCycle(i) > CellOfCycle(0)) return false;
      anew = true;
    }
    return anew && rows_.size() >= 2 * runs;
  }

  // ---- Words.

  std::string SessionsText() const {
    const auto count = static_cast<Index>(found_.sessions.labels.size());
    std::string text = Counted(count, "session");
    if (!found_.sessions.column.empty()) {
      text += " by " + QuotedName(found_.sessions.column);
    } else if (found_.by == "counter") {
      text += ", as " + QuotedName(table_.At(cycle_).name) +
              " begins anew (first at data row " + std::to_string(first_cut_) +
              ")";
    } else if (count > 1) {
      text += ", cut where " + QuotedName(TimeColumn().name) +
              (found_.by == "nights" ? " pauses for a night"
                                     : " goes back or pauses for a night") +
              " (first at data row " + std::to_string(first_cut_) + ")";
    } else {
      text += std::string(" (no column ") + kSessionColumnsText +
              ", no night in time)";
    }
    return text;
  }

  std::string TimeText() const {
    if (!found_.ordered) return "the rows are in no order of time";
    if (found_.time_column < 0) return "time is the number of the row";
    std::string text = "time by " + QuotedName(TimeColumn().name);
    if (clock_.date_column >= 0) {
      text += " and " + QuotedName(table_.At(clock_.date_column).name);
    }
    return text + clock_.words;
  }

  const CsvTable& table_;
  const DatasetSelection& selection_;
  const std::vector<Index>& rows_;
  Clock clock_;
  Nights nights_;
  std::vector<Index> passes_;
  std::ptrdiff_t cycle_;
  FoundSessions found_;
  Index first_cut_ = -1;  // data row
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
                           const std::vector<Index>& rows,
                           SessionClues clues) {
  return SessionFinder(table, selection, rows, std::move(clues)).Find();
}

}  // namespace errmap::data
