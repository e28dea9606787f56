// MakeDataset of data/measurements/dataset.h: the columns that
// column_roles.h chooses become values, checked and in their units.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "data/argument_name.h"
#include "data/column_header.h"
#include "data/columns.h"
#include "data/measurements/clock/text_times.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_roles.h"
#include "data/measurements/dataset.h"
#include "data/measurements/faults/drift_faults.h"
#include "data/measurements/faults/row_faults.h"
#include "data/measurements/input_choice.h"
#include "data/measurements/making/idle_inputs.h"
#include "data/measurements/making/parts.h"
#include "data/measurements/making/useless_inputs.h"
#include "data/measurements/making/value_checks.h"
#include "data/measurements/making/word_columns.h"
#include "data/measurements/reading/read_table.h"
#include "data/measurements/rounded.h"
#include "data/measurements/session_log.h"
#include "data/measurements/sessions.h"
#include "data/text.h"

namespace errmap::data {
namespace {

class DatasetBuilder {
 public:
  DatasetBuilder(const CsvTable& table,
                 const DatasetSelection& selection,
                 ReadTable read)
      : table_(table),
        selection_(selection),
        read_(std::move(read)),
        roles_(read_.roles) {}

  PreparedDataset Build() {
    ChooseRows();
    TakeChosenInputs();
    ReadUnits();
    CheckColumns();
    TakeTarget();
    TakeWeights();
    TakeInputs();
    if (!selection_.only_to_judge) {
      LeaveOutUseless(LeakingInputs(parts_));
      if (NumSessions() > 1) {
        LeaveOutUseless(CountingInputs(parts_, SessionOfRows(), NumSessions()));
      }
    }
    LookForFaults();
    if (!selection_.only_to_judge) {
      if (!selection_.keep_dead) LeaveOutUseless(StuckInputs(parts_, faults_));
      LookForParts();
      RequireSquaresOfInputs();
    }
    if (roles_.group != kNoColumn) {
      parts_.groups = GroupByColumn(table_, Name(roles_.group), parts_.rows);
    }
    const std::string time_column =
        found_.time_column >= 0 ? Name(found_.time_column) : "";
    if (selection_.with_log) {
      TakeLog(table_, log_rows_, BlankedInLog(), std::move(found_), &parts_);
    }
    if (selection_.align == Alignment::kFirst) {
      remarks_.push_back(AlignTarget(&parts_));
    }
    parts_.source = table_.file;
    TakeRoles();
    Reading reading = DescribedReading();
    return {.dataset = Dataset(std::move(parts_)),
            .dropped = std::move(dropped_),
            .remarks = std::move(remarks_),
            .doubts = std::move(doubts_),
            .time_column = time_column,
            .where = std::move(read_.where),
            .faults = std::move(faults_),
            .reading = std::move(reading)};
  }

 private:
  template <typename Index>
  const std::string& Name(Index index) const {
    return table_.At(index).name;
  }
  ColumnInfo Info(std::size_t index) const {
    ColumnInfo info{.name = Name(index), .unit = UnitOfColumn(Name(index))};
    if (std::ranges::find(read_.axis.positions, index) !=
        read_.axis.positions.end()) {
      info.role = Role::kPosition;
    }
    return info;
  }

  // ---- Which rows and columns.

  // Those that may be used, and their sessions.
  void ChooseRows() {
    RefuseUnreadTimes();
    passes_ = std::move(read_.passes);
    repeated_rows_ = std::move(read_.repeated_rows);
    if (!selection_.with_log) return;
    log_rows_ = std::move(read_.log_rows);
    found_ = std::move(read_.found);
    remarks_.insert(
        remarks_.end(), found_.remarks.begin(), found_.remarks.end());
    std::size_t num_unknown = 0;
    for (std::size_t i = 0; i < log_rows_.size(); ++i) {
      if (found_.known[i]) continue;
      passes_[static_cast<std::size_t>(log_rows_[i])] = false;
      ++num_unknown;
    }
    if (num_unknown > 0) {
      remarks_.push_back(std::to_string(num_unknown) + " of " +
                         std::to_string(log_rows_.size()) +
                         " rows have no time or session and are dropped");
    }
  }

  // Without its clock a file is one session, and a promise of it is too good.
  void RefuseUnreadTimes() const {
    if (!selection_.with_log || selection_.only_to_judge ||
        !selection_.time.empty() || read_.found.time_column >= 0) {
      return;
    }
    data::RefuseUnreadTimes(table_);
  }

  void TakeChosenInputs() {
    DatasetSelection selection = selection_;
    // An axis by its values is no error, whatever its unit.
    if (selection.position.empty()) selection.position = read_.position;
    ChosenInputs chosen = ChooseInputs(table_, selection, roles_, found_);
    inputs_ = std::move(chosen.inputs);
    dropped_ = std::move(chosen.dropped);
    words_ = std::move(chosen.words);
    records_ = std::move(chosen.records);
    LeaveOutWhatMeasuresNothing();
    remarks_.insert(
        remarks_.end(), chosen.remarks.begin(), chosen.remarks.end());
  }

  // Where a position was measured is known after the fact only; what numbers
  // the positions says them once more, and what counts measures nothing.
  void LeaveOutWhatMeasuresNothing() {
    const std::string axis = NameInRemark(read_.position);
    for (const std::size_t column : read_.axis.measured) {
      LeaveOut(column,
               read_.position.empty()
                   ? "reads the position, which holds the error"
                   : "reads the position that " + axis + " commands");
    }
    for (const std::size_t column : read_.axis.held) {
      LeaveOut(column, "reads an axis that stands");
    }
    for (const std::size_t column : read_.axis.numbers) {
      LeaveOut(column, "numbers the positions of " + axis);
    }
    for (const Counter& counter : read_.counters) {
      if (counter.counts == Counted::kElapsed) continue;
      LeaveOut(counter.column, std::string(ToString(counter.counts)));
    }
    for (const std::size_t column : read_.date_parts) {
      LeaveOut(column, "is a part of the date");
    }
  }

  void LeaveOut(std::size_t column, const std::string& why) {
    const auto found = std::ranges::find(inputs_, column);
    if (found == inputs_.end() || IsNamed(Name(column))) return;
    inputs_.erase(found);
    LeaveOutColumn(column, why);
  }

  // Of those that nobody named.
  void LeaveOutColumn(std::size_t column, const std::string& why) {
    LeaveOutInput(Name(column),
                  why,
                  "; name it in " + ArgumentName("inputs") + " to use it");
  }

  // ---- In which units.

  void ReadUnits() {
    RequireKnownUnit(table_, {roles_.target, ColumnUse::kTarget});
    if (const Header target = ReadHeader(Name(roles_.target));
        target.source == UnitSource::kAssumed) {
      remarks_.push_back(NameInRemark(Name(roles_.target)) +
                         ": no unit in its name, taken as " +
                         target.unit.symbol);
    }
    std::vector<std::string> unread;
    for (const std::size_t input : inputs_) {
      const UnitSource source = ReadHeader(Name(input)).source;
      if (source == UnitSource::kUnread || source == UnitSource::kUnknown) {
        unread.push_back(Name(input));
      }
    }
    if (unread.empty()) return;
    remarks_.push_back("no unit is read from " + ListOfNames(unread) + ": " +
                       WhyNoUnit(ReadHeader(unread.front())));
  }

  // ---- Which rows, and what is in them.

  // Rows are dropped for what a map can use: an input with hardly a number, or
  // with one number throughout, would cost rows and give nothing.
  void LeaveOutInputsThatCostRows() {
    if (selection_.missing != MissingPolicy::kDropRows ||
        selection_.only_to_judge) {
      return;
    }
    std::erase_if(inputs_, [&](std::size_t input) {
      return !table_.At(input).exceptions.empty() && !IsNamed(Name(input)) &&
             CostsRows(input);
    });
  }

  bool CostsRows(std::size_t input) {
    constexpr Eigen::Index kFewestRowsToTell = 12;
    constexpr Eigen::Index kFewest = 10;  // percent
    std::vector<Eigen::Index> rows;
    std::vector<Eigen::Index> with_numbers;
    for (std::size_t row = 0; row < table_.num_rows; ++row) {
      if (!passes_[row]) continue;
      rows.push_back(static_cast<Eigen::Index>(row));
      if (table_.At(input).TextAt(row) == nullptr) {
        with_numbers.push_back(rows.back());
      }
    }
    if (std::ssize(rows) < kFewestRowsToTell) return false;
    if (100 * std::ssize(with_numbers) < kFewest * std::ssize(rows)) {
      LeaveOutColumn(input,
                     "has a number in " + std::to_string(with_numbers.size()) +
                         " of " + std::to_string(rows.size()) + " rows");
      return true;
    }
    const IdleInput idle =
        HowIdle(ValuesOfRows(table_.At(input), with_numbers));
    if (!idle.dead || selection_.keep_dead) return false;
    ReportIdle(Name(input), idle);
    return true;
  }

  void CheckColumns() {
    LeaveOutInputsThatCostRows();
    std::vector<ColumnInUse> columns = {{roles_.target, ColumnUse::kTarget}};
    for (const std::size_t input : inputs_) {
      columns.push_back({input, ColumnUse::kInput});
    }
    if (roles_.group != kNoColumn) {
      columns.push_back(
          {static_cast<std::size_t>(roles_.group), ColumnUse::kGroup});
    }
    if (roles_.weight != kNoColumn) {
      columns.push_back(
          {static_cast<std::size_t>(roles_.weight), ColumnUse::kWeight});
    }
    RefuseMixedDecimals(table_, columns);
    KeptRows kept = CheckCells(table_, columns, passes_, selection_.missing);
    if (!kept.first_missing.empty()) {
      const std::size_t dropped = kept.num_passed - kept.rows.size();
      // Readings without a target still run through a map's filters.
      remarks_.push_back(
          std::to_string(dropped) + " of " + std::to_string(kept.num_passed) +
          (dropped == 1 ? " rows is " : " rows are ") +
          (selection_.only_to_judge ? "not judged" : "dropped") +
          " for missing cells; the first: " + kept.first_missing);
    }
    parts_.rows = std::move(kept.rows);
  }

  void TakeTarget() {
    parts_.target = Info(roles_.target);
    parts_.target_values = ValuesOfRows(table_.At(roles_.target), parts_.rows);
    RequireSquares(table_,
                   parts_.rows,
                   "target",
                   parts_.target.name,
                   parts_.target_values);
    if (selection_.only_to_judge) return;
    AskForUnit(table_,
               parts_.target.name,
               parts_.target_values,
               !selection_.target.empty());
    if (auto remark = UnlikelySize(parts_.target, parts_.target_values)) {
      remarks_.push_back(std::move(*remark));
    }
    const double first = parts_.target_values(0);
    if (!(parts_.target_values.array() == first).all()) return;
    ThrowUnusable(
        table_,
        "target " + QuotedName(Name(roles_.target)) +
            (parts_.rows.size() == 1
                 ? " has a single row"
                 : " is constant (" + CsvNumber(first) + " in all " +
                       std::to_string(parts_.rows.size()) + " rows)") +
            ", so there is nothing to map; name another with " +
            ArgumentName("target"));
  }

  void RequireSquaresOfInputs() const {
    for (std::size_t i = 0; i < parts_.inputs.size(); ++i) {
      RequireSquares(table_,
                     parts_.rows,
                     "input",
                     parts_.inputs[i].name,
                     parts_.input_values.col(static_cast<Eigen::Index>(i)));
    }
  }

  void TakeWeights() {
    if (roles_.weight == kNoColumn) return;
    parts_.weights = WeightsOf(table_, table_.At(roles_.weight), parts_.rows);
  }

  void TakeInputs() {
    const Eigen::VectorXd& target = parts_.target_values;
    parts_.input_values.resize(target.size(),
                               static_cast<Eigen::Index>(inputs_.size()));
    Eigen::Index used = 0;
    for (const std::size_t input : inputs_) {
      // A dead column is overwritten by the next.
      parts_.input_values.col(used) =
          ValuesOfRows(table_.At(input), parts_.rows);
      const IdleInput idle = selection_.only_to_judge
                                 ? IdleInput{}
                                 : HowIdle(parts_.input_values.col(used));
      if (!idle.how.empty()) ReportIdle(Name(input), idle);
      if (idle.dead && !selection_.keep_dead) continue;
      parts_.inputs.push_back(Info(input));
      if (!idle.dead && !selection_.only_to_judge && IsRepeated(input)) {
        parts_.inputs.pop_back();
        continue;
      }
      ++used;
    }
    if (used == 0 && !inputs_.empty()) ThrowNoInputs(table_, dropped_);
    parts_.input_values.conservativeResize(Eigen::NoChange, used);
  }

  // Whether the last input says once more what another says, and is left out:
  // a map would share its weight between them by chance.
  bool IsRepeated(std::size_t input) {
    RepeatedInputs::Found found = repeated_.Look(parts_);
    std::ranges::move(found.remarks, std::back_inserter(remarks_));
    if (found.repeats.empty()) return false;
    const std::string why =
        "repeats " + NameInRemark(found.repeats) + " value for value";
    if (IsNamed(Name(input))) {
      remarks_.push_back("input " + NameInRemark(Name(input)) + " " + why +
                         "; both are kept");
      return false;
    }
    LeaveOutColumn(input, why);
    return true;
  }

  // Of rows left out, the log keeps what else they hold.
  std::span<const ColumnFault> BlankedInLog() const {
    if (selection_.faults != FaultPolicy::kDropRows) return {};
    return faults_;
  }

  Eigen::Index NumSessions() const {
    return static_cast<Eigen::Index>(found_.sessions.labels.size());
  }

  std::vector<Eigen::Index> SessionOfRows() const {
    std::vector<Eigen::Index> sessions;
    for (const Eigen::Index row : parts_.rows) {
      sessions.push_back(found_.sessions.codes[static_cast<std::size_t>(
          std::ranges::lower_bound(log_rows_, row) - log_rows_.begin())]);
    }
    return sessions;
  }

  // Before anything is made of the rows.
  void LookForFaults() {
    const MeasuredColumns measured{.target = parts_.target,
                                   .target_values = parts_.target_values,
                                   .inputs = parts_.inputs,
                                   .input_values = parts_.input_values,
                                   .rows = parts_.rows,
                                   .num_sessions = NumSessions()};
    faults_ = FindColumnFaults(measured);
    if (std::optional<ColumnFault> drift =
            FindColdDrift(measured,
                          NumSessions() == 0 ? std::vector<Eigen::Index>()
                                             : RunStarts(SessionOfRows()),
                          faults_)) {
      faults_.push_back(*std::move(drift));
    }
    if (!repeated_rows_.empty()) {
      faults_.insert(faults_.begin(),
                     {.kind = FaultKind::kRepeated,
                      .input = -1,
                      .rows = repeated_rows_,
                      .of_cells = true});
    }
    if (selection_.faults != FaultPolicy::kDropRows) {
      for (const ColumnFault& fault : faults_) {
        if (std::string doubt = DoubtOfRows(fault, measured); !doubt.empty()) {
          doubts_.push_back(std::move(doubt));
        }
      }
      return;
    }
    const std::vector<Eigen::Index> faulty = RowsOfCellFaults(faults_);
    std::vector<Eigen::Index> kept;
    for (std::size_t i = 0; i < parts_.rows.size(); ++i) {
      if (!std::ranges::binary_search(faulty, parts_.rows[i])) {
        kept.push_back(static_cast<Eigen::Index>(i));
      }
    }
    KeepRows(kept, &parts_);
  }

  bool IsNamed(const std::string& input) const {
    return std::ranges::find(selection_.inputs, input) !=
           selection_.inputs.end();
  }

  // A remark, which the answer repeats where somebody asked for the input.
  void LeaveOutInput(const std::string& input,
                     const std::string& why,
                     const std::string& behind) {
    dropped_.push_back({.column = input, .why = why});
    const std::string what = why + " and is left out" + behind;
    RemarkOnLeftOut(NameInRemark(input), what);
    if (!IsNamed(input)) return;
    doubts_.push_back("The input " + NameInRemark(input) + ", asked for by " +
                      ArgumentName("inputs") + ", " + what + ".");
  }

  // One line for those that the same is said of, one after another.
  void RemarkOnLeftOut(const std::string& name, const std::string& what) {
    const std::string of_one = "input " + name + " " + what;
    if (what != said_of_all_.what || remarks_.empty() ||
        remarks_.back() != said_of_all_.remark) {
      said_of_all_ = {.what = what, .names = {name}, .remark = of_one};
      remarks_.push_back(of_one);
      return;
    }
    said_of_all_.names.push_back(name);
    said_of_all_.remark =
        "inputs " + JoinWords(said_of_all_.names, ", ") + ": each " + what;
    remarks_.back() = said_of_all_.remark;
  }

  void ReportIdle(const std::string& input, const IdleInput& idle) {
    if (!idle.dead) {
      remarks_.push_back("input " + NameInRemark(input) + " is " + idle.how +
                         " and is kept: what it does rests on the others");
      return;
    }
    const std::string why = "is dead (" + idle.how + ")";
    if (selection_.keep_dead) {
      remarks_.push_back("input " + NameInRemark(input) + " " + why +
                         " and is kept");
      return;
    }
    LeaveOutInput(input, why, "; " + ArgumentName("keep_dead") + " keeps it");
  }

  // And the faults of these.
  void LeaveOutUseless(const std::vector<UselessInput>& useless) {
    std::vector<bool> left_out(parts_.inputs.size(), false);
    for (const UselessInput& one : useless) {
      const auto at = static_cast<std::size_t>(one.input);
      const std::string& name = parts_.inputs[at].name;
      if (left_out[at] || (IsNamed(name) && !one.even_named)) continue;
      left_out[at] = true;
      LeaveOutInput(name, one.why, one.behind);
    }
    if (std::ranges::count(left_out, true) == 0) return;
    if (std::ranges::count(left_out, false) == 0) {
      ThrowNoInputs(table_, dropped_);
    }
    std::erase_if(faults_, [&](const ColumnFault& fault) {
      return fault.input >= 0 &&
             left_out[static_cast<std::size_t>(fault.input)];
    });
    const std::vector<Eigen::Index> places = LeaveOutInputs(left_out, &parts_);
    for (ColumnFault& fault : faults_) {
      if (fault.input < 0) continue;
      fault.input = places[static_cast<std::size_t>(fault.input)];
    }
  }

  // By name and values, where the axis has not said it.
  void TakeRoles() {
    const Eigen::MatrixXd& values =
        parts_.input_values.cols() > 0 ? parts_.input_values : LogValues();
    for (std::size_t i = 0; i < parts_.inputs.size(); ++i) {
      ColumnInfo& input = parts_.inputs[i];
      if (input.role != Role::kUnknown) continue;
      input.role = RoleByName(input);
      if (input.role == Role::kSensor && input.unit.symbol.empty() &&
          HasTwoValues(values.col(static_cast<Eigen::Index>(i)))) {
        input.role = Role::kSwitch;
      }
    }
  }

  const Eigen::MatrixXd& LogValues() const {
    static const Eigen::MatrixXd kNone;
    return parts_.log ? parts_.log->input_values : kNone;
  }

  // The reading, with what the values of the columns in use added.
  Reading DescribedReading() {
    Reading reading = std::move(read_.reading);
    reading.rows = std::ssize(parts_.rows);
    reading.remarks = remarks_;
    for (const DroppedColumn& column : dropped_) {
      reading.left_out.push_back({.column = column.column, .why = column.why});
      if (reading.position.column == column.column) reading.position = {};
    }
    for (const std::size_t column : records_) {
      if (reading.position.column != Name(column)) {
        reading.left_out.push_back(
            {.column = Name(column),
             .why = "tells rows apart and measures nothing"});
      }
    }
    for (const ColumnInfo& input : parts_.inputs) {
      if (input.role == Role::kPosition) continue;
      (input.role == Role::kSwitch    ? reading.switches
       : input.role == Role::kCounter ? reading.counters
                                      : reading.sensors)
          .push_back(input.name);
    }
    return reading;
  }

  // Rows of several machines, tools or directions, which err differently.
  void LookForParts() {
    for (PartingRemark& remark :
         FindParts(table_,
                   words_,
                   parts_,
                   NumSessions() > 1 ? SessionOfRows()
                                     : std::vector<Eigen::Index>())) {
      if (remark.is_doubt) doubts_.push_back(remark.text);
      remarks_.push_back(std::move(remark.text));
    }
  }

  const CsvTable& table_;
  const DatasetSelection& selection_;
  ReadTable read_;
  ColumnRoles roles_;
  std::vector<std::size_t> inputs_;  // columns of the table
  Dataset::Parts parts_;
  std::vector<bool> passes_;            // (rows of the table)
  std::vector<Eigen::Index> log_rows_;  // rows that may be used
  FoundSessions found_;                 // of those
  RepeatedInputs repeated_;
  std::vector<DroppedColumn> dropped_;
  std::vector<std::string> remarks_;
  struct {
    std::string what;
    std::vector<std::string> names;
    std::string remark;  // that is on all of them
  } said_of_all_;
  std::vector<ColumnFault> faults_;
  std::vector<std::size_t> words_;  // columns that name things
  std::vector<std::size_t> records_;
  std::vector<Eigen::Index> repeated_rows_;
  std::vector<std::string> doubts_;
};

}  // namespace

PreparedDataset MakeDataset(const CsvTable& table,
                            const DatasetSelection& selection) {
  ReadTable read = ReadRoles(table, selection);
  // Moved out first: the builder reads from one table only.
  const std::optional<CsvTable> as_read = std::move(read.table);
  const CsvTable& used = as_read ? *as_read : table;
  PreparedDataset prepared =
      DatasetBuilder(used, selection, std::move(read)).Build();
  for (std::vector<std::string>* const remarks :
       {&prepared.remarks, &prepared.reading.remarks}) {
    remarks->insert(remarks->begin(), used.remarks.begin(), used.remarks.end());
  }
  return prepared;
}

}  // namespace errmap::data
