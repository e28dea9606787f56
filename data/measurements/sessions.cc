#include "data/measurements/sessions.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "data/argument_name.h"
#include "data/column_words.h"
#include "data/columns.h"
#include "data/measurements/clock/clock.h"
#include "data/measurements/clock/date_time.h"
#include "data/measurements/clock/row_columns.h"
#include "data/measurements/clock/time_units.h"
#include "data/measurements/joined_tables.h"
#include "data/measurements/reading/session_starts.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

class SessionFinder : private RowColumns {
 public:
  SessionFinder(const CsvTable& table,
                const DatasetSelection& selection,
                const std::vector<Index>& rows,
                SessionClues clues)
      : RowColumns(table, selection, rows),
        clock_(std::move(clues.clock)),
        nights_(clues.nights),
        passes_(std::move(clues.passes)),
        cycles_in_sessions_(clues.cycles_in_sessions),
        blocks_(clues.blocks),
        rows_repeat_(clues.rows_repeat) {
    found_.ordered = clues.ordered;
    if (clues.ordered) {
      restarts_ = FindCycleRestarts(table, rows, clues.cycles);
    }
  }

  FoundSessions Find() {
    TakeClock();
    ChooseSessions();
    if (found_.sessions.column.empty()) {
      CutSessions();
    } else {
      RefuseTimeGoingBack();
    }
    return std::move(found_);
  }

 private:
  const CsvColumn& TimeColumn() const { return table_.At(found_.time_column); }

  void TakeClock() {
    found_.remarks = clock_.remarks;
    found_.known = clock_.known;
    found_.time = clock_.time;
    found_.time_column = clock_.column;
    found_.date_column = clock_.date_column;
    found_.dated = clock_.dated;
    found_.time_unit = clock_.is_found() ? "s" : "rows";
    if (!selection_.time.empty() || !clock_.is_found()) return;
    const bool in_files = BeginsAnewIn(FilesOfSessions());
    if (!in_files && !BeginsAnewIn(passes_)) return;
    Skip(QuotedName(TimeColumn().name) + " restarts with each " +
             (in_files ? "file, so it tells no time"
                       : "pass along the axis, so it shows no pauses") +
             " between them",
         &found_.remarks);
    UseRowNumbers();
  }

  // The file of each row, where a session is of several; else nothing.
  std::vector<Index> FilesOfSessions() const {
    const std::ptrdiff_t file = table_.Find(kFileColumn);
    if (file < 0 || table_.At(file).texts.size() >= table_.parts.size()) {
      return {};
    }
    return PartsOfRows(table_, rows_);
  }

  // Whether the time goes back where nearly each pass or file begins, and
  // nowhere else.
  bool BeginsAnewIn(const std::vector<Index>& passes) const {
    constexpr Index kFewestPasses = 3;
    if (passes.empty() || passes.back() + 1 < kFewestPasses) return false;
    Index back = 0;
    for (std::size_t i = 1; i < passes.size(); ++i) {
      const auto at = static_cast<Index>(i);
      if (!(found_.time[at] < found_.time[at - 1])) continue;
      if (passes[i] == passes[i - 1]) return false;
      ++back;
    }
    constexpr Index kNearlyAll = 90;  // percent
    return 100 * back >= kNearlyAll * passes.back();
  }

  void UseRowNumbers() {
    found_.time_column = -1;
    found_.dated = false;
    found_.time_unit = "rows";
    found_.time = RowNumbers();
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

  // ---- Sessions.

  // The columns that are called so, the likeliest first.
  std::vector<std::size_t> CalledSessions() const {
    std::vector<std::size_t> found;
    const auto add = [&](const auto& called) {
      for (const std::size_t i : ColumnsOf(called)) {
        if (std::ranges::find(found, i) == found.end() &&
            !std::cmp_equal(i, cycles_in_sessions_)) {
          found.push_back(i);
        }
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
      if (found_.sessions.labels.size() < 2) {
        one_value_ = i;
        found_.sessions = {};
        continue;
      }
      if (CyclesPartFurther()) {
        found_.sessions = {};
        return;
      }
      const std::string why = WhyNoSessions(i);
      if (why.empty()) return;
      found_.remarks.push_back("column " + QuotedName(table_.columns[i].name) +
                               " " + why);
      found_.sessions = {};
    }
    // A column of dates tells the days where the time does not.
    if (found_.time_column >= 0 && !clock_.hours_alone) return;
    const std::ptrdiff_t date = ColumnOfDates(table_, selection_);
    if (date < 0 ||
        (restarts_ && CountOver(*restarts_, table_.At(date), rows_)) ||
        !TakeSessions(static_cast<std::size_t>(date), false)) {
      return;
    }
    found_.by = "dates";
    if (CyclesPartFurther()) found_.sessions = {};
  }

  bool CyclesPartFurther() const {
    return restarts_ && PartFurther(*restarts_, found_.sessions, table_, rows_);
  }

  // Whether one clock runs through all of several files, so that its pauses
  // tell the sessions and not how the rows were saved.
  bool ClockGoesOnOverFiles() const {
    if (found_.time_column < 0) return false;
    std::set<Index> firsts;
    for (const auto& part : table_.parts) {
      firsts.insert(static_cast<Index>(part.first));
    }
    double within = 0.0;
    double between = 0.0;
    for (Index i = 1; i < found_.time.size(); ++i) {
      const double step = found_.time[i] - found_.time[i - 1];
      if (step < 0.0) return false;
      const bool is_first = firsts.contains(rows_[i]);
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
    // Days, and what is called a session, may be of one pass each.
    const bool is_surely = Says(column.name, Word::kDay) ||
                           EqualsIgnoringCase(column.name, "session");
    if (!is_surely && !passes_.empty() && IsPassOfEach(codes)) {
      return "numbers passes along the axis, which are not sessions";
    }
    if (come_again_ &&
        (found_.dated || ColumnOfDates(table_, selection_) >= 0)) {
      return "comes again on other days";
    }
    if (!found_.dated || column.name == kFileColumn) return "";
    // A shift goes on over midnight.
    bool any = false;
    for (std::size_t i = 1; i < codes.size(); ++i) {
      if (codes[i] == codes[i - 1]) continue;
      const double now = found_.time[static_cast<Index>(i)];
      const double before = found_.time[static_cast<Index>(i) - 1];
      if (std::floor(now / kSecondsOfDay) ==
          std::floor(before / kSecondsOfDay)) {
        return "";  // not the days of the calendar
      }
      any = any || (now >= before &&
                    now - before <= std::min(nights_.gap, kShortestNight));
    }
    return any ? "changes at midnight during a run; sessions are separated "
                 "by " +
                     QuotedName(TimeColumn().name)
               : "";
  }

  // Whether hardly a pass begins without another code: of each pass one, or the
  // two ways of it one each, counted on or anew each day.
  bool IsPassOfEach(const std::vector<Index>& codes) const {
    Index begun = 0;
    Index alike = 0;
    for (std::size_t i = 1; i < codes.size(); ++i) {
      if (passes_[i] == passes_[i - 1]) continue;
      ++begun;
      alike += codes[i] == codes[i - 1] ? 1 : 0;
    }
    constexpr Index kHardly = 10;
    return begun >= 2 && kHardly * alike <= begun;
  }

  bool TakeSessions(std::size_t index, bool named) {
    const CsvColumn& column = table_.columns[index];
    std::vector<Index> rows_known;
    std::vector<bool> here(rows_.size(), true);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const std::size_t row = DataRow(i);
      if (std::isnan(column.values[row]) &&
          IsMissingText(table_.CellText(column, row))) {
        if (!MayBeMissing(index, row, named, &found_.remarks)) return false;
        here[i] = false;
      } else {
        rows_known.push_back(rows_[i]);
      }
    }
    if (rows_known.empty() && !named) {
      Skip("column " + QuotedName(column.name) + " is empty", &found_.remarks);
      return false;
    }
    Grouping sessions = GroupByColumn(table_, column.name, rows_known);
    // Every row by itself: a number of the row, not of a run.
    if (!named && sessions.labels.size() > 1 &&
        sessions.labels.size() == rows_known.size()) {
      Skip("column " + QuotedName(column.name) + " has " +
               std::to_string(sessions.labels.size()) + " values in " +
               std::to_string(rows_known.size()) +
               " rows, which are not sessions",
           &found_.remarks);
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
    if (!rows_repeat_) PartWhatComesAgain(&sessions);
    found_.sessions = std::move(sessions);
    found_.by = "column";
    found_.evidence = Evidence::kName;
    return true;
  }

  // Whether a column of weeks stands beside the runs of a number, which is a
  // weekday: in each week it comes once.
  bool ComeOnceAWeek(const Grouping& sessions,
                     const std::vector<Index>& starts) const {
    return std::ranges::any_of(table_.columns, [&](const CsvColumn& weeks) {
      if (weeks.name == sessions.column || !IsCalled(weeks.name, Word::kWeek)) {
        return false;
      }
      std::set<std::pair<Index, std::string>> pairs;
      for (const Index start : starts) {
        const auto first = static_cast<std::size_t>(start);
        pairs.emplace(sessions.codes[first],
                      table_.CellText(weeks, DataRow(first)));
      }
      return pairs.size() == starts.size();
    });
  }

  // "day", "night", "day" are three sessions, the last of them "day (2)". What
  // has a number or a date is the same day, as where directions or files stand
  // one below the other; but shifts have numbers, too, and so have weekdays.
  void PartWhatComesAgain(Grouping* sessions) {
    constexpr std::size_t kFewestRows = 8;
    const std::vector<Index> starts = RunStarts(sessions->codes);
    come_again_ = starts.size() > sessions->labels.size();
    if (!found_.ordered || !come_again_ || table_.parts.size() > 1 ||
        rows_.size() < kFewestRows * starts.size() ||
        (std::ranges::any_of(sessions->labels, HasDigit) &&
         !IsCalled(sessions->column, Word::kShift) &&
         !ComeOnceAWeek(*sessions, starts))) {
      return;
    }
    std::vector<Index> times(sessions->labels.size(), 0);
    std::vector<std::string> labels;
    std::vector<Index> codes = sessions->codes;
    for (std::size_t run = 0; run < starts.size(); ++run) {
      const auto first = static_cast<std::size_t>(starts[run]);
      const auto code = static_cast<std::size_t>(sessions->codes[first]);
      const std::size_t end = run + 1 < starts.size()
                                  ? static_cast<std::size_t>(starts[run + 1])
                                  : codes.size();
      std::fill(codes.begin() + static_cast<std::ptrdiff_t>(first),
                codes.begin() + static_cast<std::ptrdiff_t>(end),
                static_cast<Index>(run));
      const Index time = ++times[code];
      labels.push_back(
          sessions->labels[code] +
          (time > 1 ? " (" + std::to_string(time) + ")" : std::string()));
    }
    sessions->labels = std::move(labels);
    sessions->codes = std::move(codes);
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
                       ", or use the row numbers with " +
                       ArgumentName("time", "none"));
    }
  }

  // Sessions begin anew where time does, or after a night.
  void CutSessions() {
    const auto n = static_cast<Index>(rows_.size());
    const Index num_back = TimesBack(found_.time);
    // Runs of fewer than four rows are not sessions but disorder.
    constexpr Index kFewestRows = 4;
    if (num_back * kFewestRows > n) {
      PassOver(!selection_.time.empty(),
               PrintablePath(table_.file) + ": " +
                   QuotedName(TimeColumn().name) + " goes back at " +
                   std::to_string(num_back) + " of " + std::to_string(n - 1) +
                   " steps, so the rows are not in order of time",
               "sort them, or name the column of sessions with " +
                   ArgumentName("session"),
               &found_.remarks);
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
    if (found_.by == "clock") TakeBlocksOfClock();
    if (found_.by != "one" ||
        (one_value_ && TakeSessions(*one_value_, false))) {
      return;
    }
    if (CutWhereCyclesCountAnew()) return;
    if (!found_.ordered) return;
    if (found_.time_column < 0 && blocks_ >= 0 &&
        TakeSessions(static_cast<std::size_t>(blocks_), false)) {
      found_.evidence = Evidence::kValues;
      return;
    }
    // What counts hours of work stands still overnight.
    const bool may_stand = found_.time_column < 0 || !found_.dated;
    if (may_stand && selection_.session.empty()) CutAtColdStarts();
  }

  // A clock without dates does not go back where a day begins later than the
  // one before it ended: blocks of rows that begin wherever it does, and hardly
  // elsewhere, are the days.
  void TakeBlocksOfClock() {
    if (found_.dated || blocks_ < 0 || !selection_.gap.empty() ||
        !selection_.session.empty()) {
      return;
    }
    const std::vector<double> blocks = ValuesOf(table_.At(blocks_));
    const std::size_t by_clock = found_.sessions.labels.size();
    std::size_t by_block = 1;
    for (std::size_t i = 1; i < blocks.size(); ++i) {
      const bool begins = blocks[i] != blocks[i - 1];
      by_block += begins ? 1 : 0;
      if (!begins && found_.sessions.codes[i] != found_.sessions.codes[i - 1]) {
        return;
      }
    }
    const bool hardly = 2 * (by_clock - 1) > by_block - 1;
    if (by_block == by_clock || !hardly ||
        !TakeSessions(static_cast<std::size_t>(blocks_), false)) {
      return;
    }
    found_.evidence = Evidence::kValues;
    found_.alternative = std::to_string(by_clock) + ", where " +
                         QuotedName(TimeColumn().name) + " goes back";
  }

  void CutAtColdStarts() {
    const ColdStarts starts = FindColdStarts(table_, rows_, passes_);
    if (starts.rows.empty()) return;
    if (!starts.at_rest) {
      found_.alternative = std::to_string(starts.rows.size() + 1) +
                           ", as the temperatures fall at data row " +
                           std::to_string(DataRow(
                               static_cast<std::size_t>(starts.rows.front())));
      return;
    }
    CutWhere([&](std::size_t i) {
      return std::ranges::binary_search(starts.rows, static_cast<Index>(i));
    });
    found_.by = "rest";
    found_.alternative = "one";
  }

  bool CutWhereCyclesCountAnew() {
    if (!restarts_) return false;
    CutWhere([&](std::size_t i) { return restarts_->begins[i]; });
    found_.by = "counter";
    found_.counter = restarts_->column;
    return true;
  }

  template <typename Begins>
  void CutWhere(const Begins& begins) {
    found_.sessions = {};
    Index session = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (i > 0 && begins(i)) ++session;
      found_.sessions.codes.push_back(session);
    }
    for (Index i = 0; i <= session; ++i) {
      found_.sessions.labels.push_back(std::to_string(i + 1));
    }
  }

  Clock clock_;
  Nights nights_;
  std::vector<Index> passes_;
  std::optional<CycleRestarts> restarts_;
  std::ptrdiff_t cycles_in_sessions_;
  std::ptrdiff_t blocks_;
  std::optional<std::size_t> one_value_;  // a column of sessions: one in all
  bool rows_repeat_;
  bool come_again_ = false;  // names of sessions, after others
  FoundSessions found_;
};

}  // namespace

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

FoundSessions FindSessions(const CsvTable& table,
                           const DatasetSelection& selection,
                           const std::vector<Index>& rows,
                           SessionClues clues) {
  return SessionFinder(table, selection, rows, std::move(clues)).Find();
}

}  // namespace errmap::data
