#include "data/measurements/reading/read_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "data/argument_name.h"
#include "data/column_words.h"
#include "data/columns.h"
#include "data/files/shown_path.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/faults/row_faults.h"
#include "data/measurements/reading/derived_columns.h"
#include "data/measurements/reading/describe_reading.h"
#include "data/measurements/reading/digit_dates.h"
#include "data/measurements/reading/directions.h"
#include "data/measurements/reading/label_parts.h"
#include "data/measurements/reading/merged_cells.h"
#include "data/measurements/reading/midnight.h"
#include "data/measurements/reading/row_order.h"
#include "data/measurements/row_filters.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

constexpr std::size_t kNoTarget = static_cast<std::size_t>(-1);
constexpr Index kFewestRowsInOrder = 12;

// What parts sessions: nights in the clock, or a pause that somebody gave.
Nights NightsOf(const Clock& clock,
                const Motion& motion,
                const DatasetSelection& selection) {
  Nights nights = FindNights(clock.time, motion, clock.dated);
  if (!clock.is_found()) nights.gap = INFINITY;
  if (selection.gap.empty()) return nights;
  const std::optional<double> gap = ParseInterval(selection.gap);
  if (!gap) {
    throw InputError(ArgumentName("gap", selection.gap) +
                     ": is no length of time; give 2h, 90min or 30s");
  }
  nights.gap = *gap;
  return nights;
}

class TableReader {
 public:
  TableReader(const CsvTable& table, const DatasetSelection& selection)
      : given_(table), selection_(selection) {}

  ReadTable Read() {
    read_.where = selection_.where;
    TakeAsMeant();
    TakeTarget();
    read_.roles = ChooseRoles(table(), WithoutDerivedCycles());
    read_.reading.rows = static_cast<std::int64_t>(given_.num_rows);
    ChooseBaseRows();
    if (selection_.only_to_judge) {
      TakeRows();
      if (selection_.with_log) FindSessionsOfRows();
      return std::move(read_);
    }
    FindOrder();
    if (selection_.target.empty() && read_.axis.column >= 0) {
      for (const std::size_t measured : read_.axis.measured) {
        RequireDifference(
            table(),
            read_.roles.target,
            {.read = measured,
             .commanded = static_cast<std::size_t>(read_.axis.column)});
      }
    }
    FindDirection();
    if (ordered_) {
      const Motion& motion = Passes();
      read_.counters = FindCounters(table(),
                                    selection_,
                                    read_.roles.target,
                                    base_rows_,
                                    motion.is_commanded ? motion : Motion());
      std::erase_if(read_.counters, [&](const Counter& counter) {
        return static_cast<std::ptrdiff_t>(counter.column) == read_.axis.column;
      });
    }
    FindCycles();
    FindBlocksInLabels();
    if (!selection_.group.empty() && read_.roles.group == kNoColumn) {
      RequireColumn(table(), selection_.group, ArgumentName("group"));
    }
    TakeRows();
    if (selection_.with_log) FindSessionsOfRows();
    DescribeReading(given_, selection_, clock_, nights_, &read_);
    return std::move(read_);
  }

  ReadTable ReadForMap() {
    is_for_map_ = true;
    looks_for_axis_ = !selection_.position.empty();
    TakeAsMeant();
    const std::ptrdiff_t target = table().Find(selection_.target);
    read_.roles.target =
        target < 0 ? kNoTarget : static_cast<std::size_t>(target);
    read_.roles.group = CycleColumn(table());
    read_.reading.rows = static_cast<std::int64_t>(given_.num_rows);
    base_rows_ = AllRows(given_.num_rows);
    FindOrder();
    FindDirection();
    FindCycles();
    read_.log_rows = base_rows_;
    try {
      FindSessionsOfRows();
    } catch (const InputError&) {
      // A map without a memory needs none; one with it says so later.
    }
    DescribeReading(given_, selection_, clock_, nights_, &read_);
    return std::move(read_);
  }

 private:
  const CsvTable& table() const { return read_.table ? *read_.table : given_; }
  void AddColumn(CsvColumn column) {
    if (!read_.table) read_.table = Borrowed(given_);
    read_.table->columns.push_back(std::move(column));
  }
  // In the place of another, or behind the last.
  void PutColumn(std::size_t place, CsvColumn column) {
    AddColumn(std::move(column));
    std::vector<CsvColumn>& columns = read_.table->columns;
    if (place + 1 >= columns.size()) return;
    std::swap(columns[place], columns.back());
    columns.pop_back();
  }

  // What a spreadsheet or a program wrote otherwise than it was meant.
  void TakeAsMeant() {
    const std::vector<FilledColumn> merged = FindMergedCells(given_);
    if (!merged.empty()) {
      read_.table = Borrowed(given_);
      FillMergedCells(merged, &*read_.table);
    }
    DigitDates dates = FindDigitDates(table());
    if (!dates.columns.empty()) {
      if (!read_.table) read_.table = Borrowed(given_);
      WriteDates(dates, &*read_.table);
    }
    read_.date_parts = std::move(dates.parts);
  }

  // "-correction_um": the error that a correction is against; or a difference.
  void TakeTarget() {
    const std::string& target = selection_.target;
    std::optional<DerivedTarget> derived = FindDerivedTarget(given_, target);
    if (!derived) return;  // a column, or to be refused by its name
    // In the place of the only one: its values are no axis and no input.
    PutColumn(derived->of.value_or(table().columns.size()),
              std::move(derived->column));
    if (target.starts_with('-')) read_.reading.target.sign = -1;
  }

  // A study names the cycles that were found by the column that they then got.
  DatasetSelection WithoutDerivedCycles() const {
    DatasetSelection selection = selection_;
    if (selection.group == kCycleColumn && given_.Find(kCycleColumn) < 0) {
      selection.group.clear();
    }
    return selection;
  }

  bool IsDerived(const ColumnFilter& filter) const {
    return filter.column == kDirectionColumn &&
           given_.Find(kDirectionColumn) < 0;
  }

  // What the filters leave that need no position.
  void ChooseBaseRows() {
    std::vector<ColumnFilter> filters;
    for (const ColumnFilter& filter : selection_.where) {
      if (!IsDerived(filter)) filters.push_back(filter);
    }
    std::vector<bool> passes = RowsThatPass(table(), filters);
    LeaveOutWords(&passes);
    for (std::size_t row = 0; row < passes.size(); ++row) {
      if (passes[row]) base_rows_.push_back(static_cast<Index>(row));
    }
  }

  // Rows of totals and remarks.
  void LeaveOutWords(std::vector<bool>* passes) {
    std::vector<bool> numbering;
    for (const CsvColumn& column : table().columns) {
      numbering.push_back(KeepsRecord(column.name) ||
                          IsCalled(column.name, Word::kTime));
    }
    if (read_.roles.group != kNoColumn) {
      numbering[static_cast<std::size_t>(read_.roles.group)] = true;
    }
    const std::vector<Index> left_out =
        LeaveOutRowsOfWords(table(), numbering, selection_.missing, passes);
    if (left_out.empty()) return;
    std::vector<Index> kept = AllRows(table().num_rows);
    for (const Index row : left_out) {
      kept[static_cast<std::size_t>(row)] = -1;
      read_.reading.rows_left_out.push_back(
          {.row = row, .why = "holds words where the others have numbers"});
    }
    // Their words are no times either.
    if (!read_.table) read_.table = Borrowed(given_);
    for (CsvColumn& column : read_.table->columns) {
      if (column.is_text()) column = data::TakeRows(column, kept);
    }
  }

  // With dates, rows that are alike in all else are one reading that was saved
  // twice. False where there are none.
  bool LeaveOutSavedTwice() {
    std::vector<bool> is_kept = IsBaseRow();
    const std::vector<Index> again =
        RepeatedRows(table(), read_.roles.target, is_kept);
    if (again.empty()) return false;
    for (const Index row : again) {
      is_kept[static_cast<std::size_t>(row)] = false;
      read_.reading.rows_left_out.push_back(
          {.row = row, .why = "stands twice, with its time"});
    }
    std::erase_if(base_rows_, [&](Index row) {
      return !is_kept[static_cast<std::size_t>(row)];
    });
    if (!read_.table) read_.table = Borrowed(given_);
    read_.table->remarks.push_back(
        PrintablePath(given_.file) + ": " + std::to_string(again.size()) +
        " rows stand twice, with their times; each is read once");
    return true;
  }

  std::vector<bool> IsBaseRow() const {
    std::vector<bool> is_base(table().num_rows, false);
    for (const Index row : base_rows_) {
      is_base[static_cast<std::size_t>(row)] = true;
    }
    return is_base;
  }

  void FindClockAndAxis() {
    clock_ = FindClock(table(), selection_, base_rows_);
    if (!looks_for_axis_) return;
    read_.axis = FindAxis(table(), selection_, read_.roles.target, base_rows_);
  }

  // Rows that are in another order than that of time are put in it, by a clock.
  void FindOrder() {
    FindClockAndAxis();
    if (!is_for_map_ && clock_.dated && LeaveOutSavedTwice()) {
      FindClockAndAxis();
    }
    const auto n = static_cast<Index>(base_rows_.size());
    const Index back = TimesBack(clock_.time);
    const bool sorted = read_.axis.motion.is_sorted && n >= kFewestRowsInOrder;
    // Dates go back hardly ever; hours, and what begins anew, each day.
    const bool often =
        4 * back > n || (clock_.dated && back >= 3 && 50 * back > n);
    const bool disorder =
        clock_.is_found() &&
        (often || (sorted && back > 0) ||
         (clock_.dated && given_.parts.size() > 1 &&
          FilesInterleave(clock_.time, PartsOfRows(given_, base_rows_))));
    const bool mixed = !clock_.is_found() && CyclesAreMixed();
    if (disorder && SortByTime()) {
      read_.reading.order = "time";
      FindClockAndAxis();
    } else if (sorted || mixed) {
      // What was sorted by position, or shuffled, tells no history.
      ordered_ = false;
      read_.reading.order = "none";
    }
    if (ordered_) {
      GoOnOverMidnight(table(), base_rows_, &clock_);
    } else {
      clock_ = {};
      clock_.known.assign(base_rows_.size(), true);
      clock_.time.resize(n);
      std::ranges::copy(base_rows_, clock_.time.begin());
    }
    nights_ = NightsOf(clock_, Passes(), selection_);
  }

  bool CyclesAreMixed() const {
    std::ptrdiff_t column = read_.roles.group;
    if (column == kNoColumn) column = FirstCalled(Word::kRun);
    if (column == kNoColumn) return false;
    std::vector<double> cycles;
    for (const Index row : base_rows_) {
      cycles.push_back(
          table().At(column).values[static_cast<std::size_t>(row)]);
    }
    const std::vector<Index>& codes = read_.axis.levels.codes;
    return AreMixed(
        cycles, codes.size() == cycles.size() ? codes : std::vector<Index>());
  }

  // -1: none.
  std::ptrdiff_t FirstCalled(Word word) const {
    const auto found = std::ranges::find_if(
        table().columns,
        [&](const CsvColumn& column) { return IsCalled(column.name, word); });
    return found == table().columns.end() ? -1
                                          : found - table().columns.begin();
  }

  const Motion& Passes() const {
    static const Motion kNone;
    return read_.axis.motion.passes.size() == base_rows_.size()
               ? read_.axis.motion
               : kNone;
  }

  // False where there is no such order.
  bool SortByTime() {
    const auto places = OrderOfTime(clock_.time, SessionLabels());
    if (!places) return false;
    std::vector<Index> order;
    std::vector<bool> taken(given_.num_rows, false);
    for (const Index place : *places) {
      order.push_back(base_rows_[static_cast<std::size_t>(place)]);
      taken[static_cast<std::size_t>(order.back())] = true;
    }
    for (std::size_t row = 0; row < taken.size(); ++row) {
      if (!taken[row]) order.push_back(static_cast<Index>(row));
    }
    read_.table = data::TakeRows(table(), order);
    read_.order = std::move(order);
    base_rows_ = AllRows(base_rows_.size());
    return true;
  }

  // Of each base row, by the column that is called so; "" without one.
  std::vector<std::string> SessionLabels() const {
    std::vector<std::string> labels(base_rows_.size());
    std::ptrdiff_t column = table().Find(selection_.session);
    if (selection_.session.empty()) column = FirstCalled(Word::kSession);
    for (std::size_t i = 0; column >= 0 && i < labels.size(); ++i) {
      labels[i] = table().CellText(table().At(column),
                                   static_cast<std::size_t>(base_rows_[i]));
    }
    return labels;
  }

  // ---- The two ways, and cycles.

  void FindDirection() {
    Reading::Direction& direction = read_.reading.direction;
    std::ptrdiff_t named = NamedDirection(table(), selection_, base_rows_);
    const bool tells = read_.axis.motion.both_ways && ordered_;
    if (named < 0 && tells) {
      named = DirectionByValues(
          table(), read_.roles.target, base_rows_, read_.axis.motion);
    }
    read_.roles.direction = named;
    if (named >= 0) {
      direction = ReadDirection(
          table(), table().At(named), base_rows_, Passes(), ordered_);
    } else if (tells) {
      AddColumn(DirectionColumn(table(), base_rows_, read_.axis.motion));
      direction = {.column = kDirectionColumn,
                   .by = "position",
                   .values = {"up", "down"},
                   .labels = {"up", "down"},
                   .evidence = Evidence::kValues,
                   .sure = true};
    } else if (read_.axis.motion.is_commanded && ordered_) {
      const auto up = std::ranges::count(read_.axis.motion.directions, 1);
      direction.by = "position";
      direction.values = {2 * up > std::ssize(base_rows_) ? "up" : "down"};
      direction.evidence = Evidence::kValues;
      direction.sure = true;
    }
    FilterByDirection();
  }

  void FilterByDirection() {
    const std::string& wanted = selection_.direction;
    if (wanted.empty() || table().Find(wanted) >= 0) return;
    const Reading::Direction& found = read_.reading.direction;
    if (const auto way = PlaceOfWay(found, wanted)) {
      if (found.column) {  // else all rows go this way
        read_.where.push_back(
            {.column = *found.column, .value = found.labels[*way]});
      }
      return;
    }
    const std::string values = JoinWords(found.values, ", ");
    ThrowUnusable(given_,
                  "no rows go " + QuotedText(wanted) +
                      (values.empty() ? "; no direction was found"
                                      : "; directions found: " + values) +
                      "; name another with " + ArgumentName("direction"));
  }

  void FindCycles() {
    Reading::Cycles& cycles = read_.reading.cycles;
    if (LabelsInParts() && Passes().is_commanded && ordered_) {
      NumberPassesAs(table().At(read_.roles.group).name);
      return;
    }
    if (read_.roles.group != kNoColumn) {
      cycles.column = table().At(read_.roles.group).name;
      cycles.by = "column";
      cycles.evidence =
          selection_.group.empty() ? Evidence::kName : Evidence::kUser;
      cycles.sure = true;
      return;
    }
    const Motion& motion = Passes();
    constexpr Index kFewestPasses = 2;
    if (!motion.is_commanded || !ordered_ ||
        motion.num_passes < kFewestPasses ||
        motion.num_passes * 3 > std::ssize(base_rows_) ||
        given_.Find(kCycleColumn) >= 0) {
      return;
    }
    const std::ptrdiff_t counter = FirstThatCounts(Counted::kPasses);
    if (counter >= 0) {
      read_.roles.group = counter;
      cycles = {.column = table().At(counter).name,
                .by = "column",
                .count = motion.num_passes,
                .evidence = Evidence::kValues,
                .sure = true};
      return;
    }
    NumberPassesAs(kCycleColumn);
  }

  // Labels of cycles that name their session, too.
  void FindBlocksInLabels() {
    if (!ordered_ || clock_.is_found() ||
        FirstThatCounts(Counted::kBlocks) >= 0) {
      return;
    }
    for (std::size_t i = 0; i < table().columns.size(); ++i) {
      const CsvColumn& column = table().columns[i];
      if (i == read_.roles.target || !column.has_name ||
          (!column.is_text() && !KeepsRecord(column.name))) {
        continue;
      }
      auto sessions = FindSessionsInLabels(table(), column, base_rows_);
      if (!sessions) continue;
      AddColumn(std::move(*sessions));
      read_.counters.push_back({table().columns.size() - 1, Counted::kBlocks});
      return;
    }
  }

  // "1.9", "1.10": as numbers the tenth cycle is the first one.
  bool LabelsInParts() const {
    if (read_.roles.group == kNoColumn || !selection_.group.empty()) {
      return false;
    }
    const CsvColumn& column = table().At(read_.roles.group);
    return !column.is_text() &&
           std::ranges::any_of(column.values, [](double value) {
             return value != std::floor(value) && !std::isnan(value);
           });
  }

  // By a column of this name, in the place of another that is called so.
  void NumberPassesAs(const std::string& name) {
    const Motion& motion = Passes();
    std::vector<double> numbers(table().num_rows, std::nan(""));
    for (std::size_t i = 0; i < base_rows_.size(); ++i) {
      numbers[static_cast<std::size_t>(base_rows_[i])] =
          static_cast<double>(motion.passes[i] + 1);
    }
    const std::ptrdiff_t named = table().Find(name);
    const std::size_t place =
        named < 0 ? table().columns.size() : static_cast<std::size_t>(named);
    PutColumn(place, NumberColumn(name, std::move(numbers)));
    read_.roles.group = static_cast<std::ptrdiff_t>(place);
    read_.reading.cycles = {.column = name,
                            .by = "position",
                            .count = motion.num_passes,
                            .evidence = Evidence::kValues,
                            .sure = true};
  }

  // -1: none.
  std::ptrdiff_t FirstThatCounts(Counted counted) const {
    const auto found =
        std::ranges::find(read_.counters, counted, &Counter::counts);
    return found == read_.counters.end()
               ? -1
               : static_cast<std::ptrdiff_t>(found->column);
  }

  // ---- Rows and sessions.

  void TakeRows() {
    read_.passes = RowsThatPass(table(), read_.where);
    const std::vector<bool> is_base = IsBaseRow();
    for (std::size_t row = 0; row < is_base.size(); ++row) {
      read_.passes[row] = read_.passes[row] && is_base[row];
    }
    if (!selection_.only_to_judge) {
      // Rows are compared as given, but for rows put in order and for a target
      // that is a difference of columns given.
      const bool as_given = given_.num_rows == table().num_rows &&
                            !Reordered() &&
                            read_.roles.target < given_.columns.size();
      read_.repeated_rows = RepeatedRows(
          as_given ? given_ : table(), read_.roles.target, read_.passes);
    }
    if (selection_.faults == FaultPolicy::kDropRows) {
      for (const Index row : read_.repeated_rows) {
        read_.passes[static_cast<std::size_t>(row)] = false;
      }
    }
    if (!selection_.with_log) return;
    for (std::size_t row = 0; row < read_.passes.size(); ++row) {
      if (read_.passes[row]) {
        read_.log_rows.push_back(static_cast<Index>(row));
      }
    }
  }

  bool Reordered() const { return read_.reading.order == "time"; }

  // The clock of the rows of the log, which are among the base rows.
  SessionClues CluesOfLog() const {
    SessionClues clues{.clock = clock_,
                       .nights = nights_,
                       .passes = {},
                       .cycles = {read_.roles.group,
                                  FirstThatCounts(Counted::kPasses),
                                  FirstThatCounts(Counted::kElapsed),
                                  FirstThatCounts(Counted::kWays)},
                       .blocks = FirstThatCounts(Counted::kBlocks),
                       .ordered = ordered_,
                       .rows_repeat = !read_.repeated_rows.empty()};
    const bool has_passes = Passes().is_commanded;
    if (read_.log_rows.size() == base_rows_.size()) {
      if (has_passes) clues.passes = Passes().passes;
      return clues;
    }
    std::vector<Index> places;
    auto at = base_rows_.begin();
    for (const Index row : read_.log_rows) {
      at = std::lower_bound(at, base_rows_.end(), row);
      places.push_back(at - base_rows_.begin());
    }
    clues.clock.time = clock_.time(places);
    clues.clock.known.clear();
    for (const Index place : places) {
      const auto i = static_cast<std::size_t>(place);
      clues.clock.known.push_back(clock_.known[i]);
      if (has_passes) clues.passes.push_back(Passes().passes[i]);
    }
    return clues;
  }

  // Rows that stand twice go back in time, which is not what is wrong.
  void FindSessionsOfRows() {
    try {
      read_.found =
          selection_.only_to_judge
              ? FindSessions(table(), selection_, read_.log_rows)
              : FindSessions(table(), selection_, read_.log_rows, CluesOfLog());
    } catch (const InputError& error) {
      if (read_.repeated_rows.empty() ||
          selection_.faults == FaultPolicy::kDropRows) {
        throw;
      }
      throw InputError(
          std::string(error.what()) + " (" +
          std::to_string(read_.repeated_rows.size()) +
          " rows repeat others value for value, the first at line " +
          std::to_string(table().LineOfRow(
              static_cast<std::size_t>(read_.repeated_rows.front()))) +
          "; " + ArgumentName("faults", "drop-rows") + " leaves them out)");
    }
  }

  const CsvTable& given_;
  const DatasetSelection& selection_;
  std::vector<Index> base_rows_;
  Clock clock_;  // of those
  Nights nights_;
  bool ordered_ = true;
  bool looks_for_axis_ = true;
  bool is_for_map_ = false;  // which answers each row
  ReadTable read_;
};

}  // namespace

ReadTable ReadRoles(const CsvTable& table, const DatasetSelection& selection) {
  return TableReader(table, selection).Read();
}

ReadTable ReadRowsForMap(const CsvTable& table,
                         const DatasetSelection& selection) {
  return TableReader(table, selection).ReadForMap();
}

FoundSessions FindSessions(const CsvTable& table,
                           const DatasetSelection& selection,
                           const std::vector<Index>& rows) {
  SessionClues clues{.clock = FindClock(table, selection, rows), .nights = {}};
  const std::ptrdiff_t target = table.Find(selection.target);
  const Axis axis =
      FindAxis(table,
               selection,
               target < 0 ? kNoTarget : static_cast<std::size_t>(target),
               rows);
  clues.ordered = !axis.motion.is_sorted;
  if (clues.ordered) GoOnOverMidnight(table, rows, &clues.clock);
  if (axis.motion.is_commanded) clues.passes = axis.motion.passes;
  clues.nights = NightsOf(clues.clock, axis.motion, selection);
  clues.cycles = {CycleColumn(table)};
  return FindSessions(table, selection, rows, std::move(clues));
}

}  // namespace errmap::data
