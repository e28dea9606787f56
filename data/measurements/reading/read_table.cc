#include "data/measurements/reading/read_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <utility>

#include "data/argument_name.h"
#include "data/files/shown_path.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/faults/row_faults.h"
#include "data/measurements/reading/column_words.h"
#include "data/measurements/reading/derived_columns.h"
#include "data/measurements/reading/describe_sessions.h"
#include "data/measurements/reading/directions.h"
#include "data/measurements/reading/pass_counter.h"
#include "data/measurements/row_filters.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

constexpr std::size_t kNoTarget = static_cast<std::size_t>(-1);
constexpr Index kFewestRowsInOrder = 12;

std::vector<Index> AllRows(std::size_t count) {
  std::vector<Index> rows(count);
  std::iota(rows.begin(), rows.end(), Index{0});
  return rows;
}

Index TimesBack(const Clock& clock) {
  Index count = 0;
  for (Index i = 1; i < clock.time.size(); ++i) {
    count += clock.time[i] < clock.time[i - 1] ? 1 : 0;
  }
  return count;
}

double GapOf(const DatasetSelection& selection, const Nights& nights) {
  if (selection.gap.empty()) return nights.gap;
  const std::optional<double> gap = ParseInterval(selection.gap);
  if (!gap) {
    throw InputError(ArgumentName("gap", selection.gap) +
                     ": is no length of time; give 2h, 90min or 30s");
  }
  return *gap;
}

class TableReader {
 public:
  TableReader(const CsvTable& table, const DatasetSelection& selection)
      : given_(table), selection_(selection) {}

  ReadTable Read() {
    read_.where = selection_.where;
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
    FindDirection();
    FindCycles();
    if (!selection_.group.empty() && read_.roles.group == kNoColumn) {
      RequireColumn(table(), selection_.group, ArgumentName("group"));
    }
    TakeRows();
    if (selection_.with_log) FindSessionsOfRows();
    Describe();
    return std::move(read_);
  }

 private:
  const CsvTable& table() const { return read_.table ? *read_.table : given_; }
  void AddColumn(CsvColumn column) {
    if (!read_.table) read_.table = Borrowed(given_);
    read_.table->columns.push_back(std::move(column));
  }
  const std::string& Name(std::size_t column) const {
    return table().columns[column].name;
  }

  // "-correction_um": the error that a correction is against.
  void TakeTarget() {
    const std::string& target = selection_.target;
    if (!target.starts_with('-') || given_.Find(target) >= 0) return;
    const std::ptrdiff_t of = given_.Find(target.substr(1));
    if (of < 0) return;  // to be refused by its name
    AddColumn(Negative(given_.At(of)));
    read_.reading.target.sign = -1;
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
    const std::vector<bool> passes = RowsThatPass(table(), filters);
    for (std::size_t row = 0; row < passes.size(); ++row) {
      if (passes[row]) base_rows_.push_back(static_cast<Index>(row));
    }
  }

  void FindClockAndAxis() {
    clock_ = FindClock(table(), selection_, base_rows_);
    read_.axis = FindAxis(table(), selection_, read_.roles.target, base_rows_);
  }

  // Rows that are in another order than that of time are put in it, by a clock.
  void FindOrder() {
    FindClockAndAxis();
    const auto n = static_cast<Index>(base_rows_.size());
    const Index back = TimesBack(clock_);
    const bool sorted = read_.axis.motion.is_sorted && n >= kFewestRowsInOrder;
    const bool disorder =
        clock_.is_found() && (4 * back > n || (sorted && back > 0));
    if (disorder && SortByTime()) {
      read_.reading.order = "time";
      FindClockAndAxis();
    } else if (sorted || disorder) {
      // What was sorted by position tells no history.
      ordered_ = !sorted;
      if (sorted) read_.reading.order = "none";
    }
    if (ordered_) {
      GoOnOverMidnight(&clock_);
    } else {
      clock_ = {};
      clock_.known.assign(base_rows_.size(), true);
      clock_.time.resize(n);
      for (Index i = 0; i < n; ++i) {
        clock_.time[i] =
            static_cast<double>(base_rows_[static_cast<std::size_t>(i)]);
      }
    }
    nights_ = FindNights(clock_.time, Passes(), clock_.dated);
    if (!clock_.is_found()) nights_.gap = INFINITY;
    nights_.gap = GapOf(selection_, nights_);
  }

  const Motion& Passes() const {
    static const Motion kNone;
    return read_.axis.motion.passes.size() == base_rows_.size()
               ? read_.axis.motion
               : kNone;
  }

  // False where times come again in other rows, as those of a clock that starts
  // anew would.
  bool SortByTime() {
    std::vector<Index> places = AllRows(base_rows_.size());
    const std::vector<std::string> sessions = SessionLabels();
    std::vector<std::pair<std::string, double>> moments;
    std::map<std::string, std::pair<double, double>> spans;
    for (const Index place : places) {
      const std::string& session = sessions[static_cast<std::size_t>(place)];
      const double at = clock_.time[place];
      moments.emplace_back(session, at);
      auto [span, is_new] = spans.try_emplace(session, at, at);
      span->second.first = std::min(span->second.first, at);
      span->second.second = std::max(span->second.second, at);
    }
    std::ranges::sort(moments);
    const auto [first, last] = std::ranges::unique(moments);
    const auto distinct = static_cast<Index>(first - moments.begin());
    if (10 * distinct < 9 * std::ssize(base_rows_)) return false;
    // One clock for all, or one for each session in its order of appearance.
    std::vector<std::pair<double, double>> in_order;
    for (const auto& [session, span] : spans) in_order.push_back(span);
    std::ranges::sort(in_order);
    bool apart = true;
    for (std::size_t i = 1; i < in_order.size(); ++i) {
      apart = apart && in_order[i].first >= in_order[i - 1].second;
    }
    std::map<std::string, std::size_t> rank;
    for (const std::string& session : sessions) {
      rank.try_emplace(session, rank.size());
    }
    std::ranges::stable_sort(places, [&](Index a, Index b) {
      const auto& of_a = sessions[static_cast<std::size_t>(a)];
      const auto& of_b = sessions[static_cast<std::size_t>(b)];
      if (!apart && of_a != of_b) return RanksBefore(of_a, of_b, rank);
      return clock_.time[a] < clock_.time[b];
    });
    std::vector<Index> order;
    for (const Index place : places) {
      order.push_back(base_rows_[static_cast<std::size_t>(place)]);
    }
    std::set<Index> taken(order.begin(), order.end());
    for (std::size_t row = 0; row < given_.num_rows; ++row) {
      if (!taken.contains(static_cast<Index>(row))) {
        order.push_back(static_cast<Index>(row));
      }
    }
    read_.table = InOrder(table(), order);
    base_rows_ = AllRows(base_rows_.size());
    return true;
  }

  static bool RanksBefore(const std::string& a,
                          const std::string& b,
                          const std::map<std::string, std::size_t>& rank) {
    double of_a = 0.0;
    double of_b = 0.0;
    if (ParseNumber(a, &of_a) && ParseNumber(b, &of_b)) return of_a < of_b;
    return rank.at(a) < rank.at(b);
  }

  // Of each base row, by the column that is called so; "" without one.
  std::vector<std::string> SessionLabels() const {
    std::vector<std::string> labels(base_rows_.size());
    std::ptrdiff_t column = table().Find(selection_.session);
    for (std::size_t i = 0;
         column < 0 && selection_.session.empty() && i < table().columns.size();
         ++i) {
      if (IsCalled(Name(i), Word::kSession)) {
        column = static_cast<std::ptrdiff_t>(i);
      }
    }
    if (column < 0) return labels;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      labels[i] = table().CellText(table().At(column),
                                   static_cast<std::size_t>(base_rows_[i]));
    }
    return labels;
  }

  // ---- The two ways, and cycles.

  void FindDirection() {
    Reading::Direction& direction = read_.reading.direction;
    const std::ptrdiff_t named =
        NamedDirection(table(), selection_, base_rows_);
    if (named >= 0) {
      ReadDirectionColumn(table().At(named));
    } else if (read_.axis.motion.both_ways && ordered_) {
      AddDirectionColumn();
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

  // Which of its two values is upwards: by the positions, else by the words.
  void ReadDirectionColumn(const CsvColumn& column) {
    Reading::Direction& direction = read_.reading.direction;
    direction.column = column.name;
    direction.by = "column";
    direction.evidence = Evidence::kName;
    direction.sure = true;
    std::vector<Index> ups;
    const std::vector<int>& ways = Passes().directions;
    for (std::size_t i = 0; i < base_rows_.size(); ++i) {
      std::string label =
          table().CellText(column, static_cast<std::size_t>(base_rows_[i]));
      const auto at =
          std::ranges::find(direction.labels, label) - direction.labels.begin();
      if (at == std::ssize(direction.labels)) {
        direction.labels.push_back(std::move(label));
        ups.push_back(0);
      }
      if (!ways.empty()) ups[static_cast<std::size_t>(at)] += ways[i];
    }
    if (direction.labels.size() != 2) {
      direction.values = direction.labels;
      return;
    }
    std::optional<bool> first_is_up;
    if (ups[0] != ups[1]) first_is_up = ups[0] > ups[1];
    if (!read_.axis.motion.both_ways || !ordered_) {
      if (const auto said = IsUpwards(direction.labels[0])) first_is_up = said;
    }
    direction.sure = first_is_up.has_value();
    if (first_is_up && !*first_is_up) {
      std::swap(direction.labels[0], direction.labels[1]);
    }
    direction.values = {"up", "down"};
  }

  void AddDirectionColumn() {
    std::vector<int> codes(table().num_rows, 2);
    for (std::size_t i = 0; i < base_rows_.size(); ++i) {
      codes[static_cast<std::size_t>(base_rows_[i])] =
          read_.axis.motion.directions[i] > 0 ? 0 : 1;
    }
    AddColumn(WordColumn(kDirectionColumn, codes, {"up", "down", ""}));
  }

  // --direction up.
  void FilterByDirection() {
    const std::string& wanted = selection_.direction;
    if (wanted.empty() || table().Find(wanted) >= 0) return;
    const Reading::Direction& found = read_.reading.direction;
    const std::optional<bool> upwards = IsUpwards(wanted);
    std::string values;
    for (std::size_t i = 0; i < found.values.size(); ++i) {
      const std::string& value = found.values[i];
      values += (values.empty() ? "" : ", ") + value;
      const bool same =
          (i < found.labels.size() && found.labels[i] == wanted) ||
          EqualsIgnoringCase(value, wanted) ||
          (upwards && IsUpwards(value) && *IsUpwards(value) == *upwards);
      if (!same) continue;
      if (found.column) {  // else all rows go this way
        read_.where.push_back(
            {.column = *found.column, .value = found.labels[i]});
      }
      return;
    }
    ThrowUnusable(given_,
                  "no rows go " + QuotedText(wanted) +
                      (values.empty() ? "; no direction was found"
                                      : "; directions found: " + values) +
                      "; name another with " + ArgumentName("direction"));
  }

  void FindCycles() {
    Reading::Cycles& cycles = read_.reading.cycles;
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
    const std::ptrdiff_t counter = PassCounter(
        table(), selection_, read_.roles.target, base_rows_, motion);
    if (counter >= 0) {
      read_.roles.group = counter;
      cycles = {.column = table().At(counter).name,
                .by = "column",
                .count = motion.num_passes,
                .evidence = Evidence::kValues,
                .sure = true};
      return;
    }
    std::vector<double> numbers(table().num_rows, std::nan(""));
    for (std::size_t i = 0; i < base_rows_.size(); ++i) {
      numbers[static_cast<std::size_t>(base_rows_[i])] =
          static_cast<double>(motion.passes[i] + 1);
    }
    AddColumn(NumberColumn(kCycleColumn, std::move(numbers)));
    read_.roles.group = static_cast<std::ptrdiff_t>(table().columns.size()) - 1;
    cycles = {.column = kCycleColumn,
              .by = "position",
              .count = motion.num_passes,
              .evidence = Evidence::kValues,
              .sure = true};
  }

  // ---- Rows and sessions.

  void TakeRows() {
    read_.passes = RowsThatPass(table(), read_.where);
    std::vector<bool> numbering;
    for (const CsvColumn& column : table().columns) {
      numbering.push_back(KeepsRecord(column.name));
    }
    if (read_.roles.group != kNoColumn) {
      numbering[static_cast<std::size_t>(read_.roles.group)] = true;
    }
    RefuseRowsOfWords(table(), numbering, read_.passes);
    if (!selection_.only_to_judge) {
      // Rows are compared as given, but for rows put in order and for a target
      // that is the negative of a column given.
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
                       .cycle = read_.roles.group,
                       .ordered = ordered_};
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

  // ---- The reading as plain data.

  void Describe() {
    Reading& reading = read_.reading;
    const CsvColumn& target = table().columns[read_.roles.target];
    reading.target.column = target.name;
    reading.target.unit = UnitOfColumn(target.name).symbol;
    reading.target.evidence =
        selection_.target.empty() ? Evidence::kName : Evidence::kUser;
    reading.target.sure = true;
    const Axis& axis = read_.axis;
    if (axis.column >= 0) {
      read_.position = table().At(axis.column).name;
      reading.position = {.column = read_.position,
                          .evidence = axis.evidence,
                          .sure = axis.sure,
                          .alternative = axis.alternative};
    } else {
      reading.position.sure = true;
    }
    DescribeTime();
    if (!read_.found.sessions.labels.empty()) {
      DescribeSessions(table(), clock_, nights_, &read_);
    }
    for (const Index row : read_.repeated_rows) {
      reading.rows_left_out.push_back(
          {.row = row, .why = "repeats another value for value"});
    }
    reading.files = {ShownPath(given_.file)};
    if (!given_.parts.empty()) {
      reading.files.clear();
      for (const auto& part : given_.parts)
        reading.files.push_back(ShownPath(part.second));
    }
  }

  void DescribeTime() {
    Reading::Time& time = read_.reading.time;
    time.unit = clock_.unit;
    time.origin = clock_.origin;
    time.evidence = clock_.evidence;
    time.sure = clock_.sure;
    time.alternative = clock_.alternative;
    if (!clock_.is_found()) return;
    time.column = table().At(clock_.column).name;
    if (clock_.date_column >= 0) {
      *time.column = table().At(clock_.date_column).name + " + " + *time.column;
    }
    std::vector<double> steps;
    for (Index i = 1; i < clock_.time.size(); ++i) {
      steps.push_back(clock_.time[i] - clock_.time[i - 1]);
    }
    const double step = MedianStep(std::move(steps));
    if (std::isfinite(step)) time.step_s = step;
  }

  const CsvTable& given_;
  const DatasetSelection& selection_;
  std::vector<Index> base_rows_;
  Clock clock_;  // of those
  Nights nights_;
  bool ordered_ = true;
  ReadTable read_;
};

}  // namespace

ReadTable ReadRoles(const CsvTable& table, const DatasetSelection& selection) {
  return TableReader(table, selection).Read();
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
  if (!axis.motion.is_sorted) GoOnOverMidnight(&clues.clock);
  if (axis.motion.is_commanded) clues.passes = axis.motion.passes;
  clues.nights = FindNights(clues.clock.time, axis.motion, clues.clock.dated);
  if (!clues.clock.is_found()) clues.nights.gap = INFINITY;
  clues.nights.gap = GapOf(selection, clues.nights);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (IsCalled(table.columns[i].name, Word::kCycle)) {
      clues.cycle = static_cast<std::ptrdiff_t>(i);
    }
  }
  return FindSessions(table, selection, rows, std::move(clues));
}

}  // namespace errmap::data
