// MakeDataset of data/measurements/dataset.h: the columns that
// column_roles.h chooses become values, checked and in their units.

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "data/argument_name.h"
#include "data/column_header.h"
#include "data/columns.h"
#include "data/measurements/builders/dataset_remarks.h"
#include "data/measurements/builders/idle_inputs.h"
#include "data/measurements/builders/inputs_in_use.h"
#include "data/measurements/builders/value_checks.h"
#include "data/measurements/clock/text_times.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_roles.h"
#include "data/measurements/dataset.h"
#include "data/measurements/faults/thermometers.h"
#include "data/measurements/reading/read_table.h"
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
        said_(selection) {}

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
        LeaveOutUseless(CountingInputs(parts_, SessionOfRows()));
        RemarkOnUnits(RunStarts(SessionOfRows()));
      }
    }
    LookForFaults();
    if (!selection_.only_to_judge) {
      if (!selection_.keep_dead) LeaveOutUseless(StuckInputs(parts_, faults_));
      SetRoles(&parts_);  // switches may tell parts
      LookForParts();
      RequireSquaresOfInputs();
    }
    if (read_.roles.group != kNoColumn) {
      parts_.groups =
          GroupByColumn(table_, Name(read_.roles.group), parts_.rows);
    }
    const std::string time_column =
        read_.found.time_column >= 0 ? Name(read_.found.time_column) : "";
    if (selection_.with_log) {
      const std::vector<Eigen::Index> sessions = SessionOfRows();
      read_.reading.sessions.count =
          std::ssize(std::set(sessions.begin(), sessions.end()));
      TakeLog(table_,
              read_.log_rows,
              BlankedInLog(),
              std::move(read_.found),
              &parts_);
    }
    if (selection_.align == Alignment::kFirst) {
      said_.remarks.push_back(AlignTarget(&parts_));
    }
    parts_.source = table_.file;
    SetRoles(&parts_);
    Reading reading = std::move(read_.reading);
    reading.rows = std::ssize(parts_.rows);
    reading.remarks = said_.remarks;
    DescribeInputs(table_, parts_, records_, said_, &reading);
    return {.dataset = Dataset(std::move(parts_)),
            .dropped = std::move(said_.dropped),
            .remarks = std::move(said_.remarks),
            .doubts = std::move(said_.doubts),
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
    if (!selection_.with_log) {
      read_.found = {};
      return;
    }
    said_.Add(read_.found.remarks);
    std::size_t num_unknown = 0;
    for (std::size_t i = 0; i < read_.log_rows.size(); ++i) {
      if (read_.found.known[i]) continue;
      read_.passes[read_.log_rows[i]] = false;
      ++num_unknown;
    }
    if (num_unknown > 0) {
      said_.remarks.push_back(std::to_string(num_unknown) + " of " +
                              std::to_string(read_.log_rows.size()) +
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
    ChosenInputs chosen = ChooseInputsAsRead(table_, selection_, read_, &said_);
    inputs_ = std::move(chosen.inputs);
    // Maps take the first position among their inputs for the axis.
    const auto axis = std::ranges::find_if(inputs_, [&](std::size_t input) {
      return std::cmp_equal(input, read_.axis.column);
    });
    if (axis != inputs_.end()) {
      std::rotate(std::ranges::find_if(
                      inputs_,
                      [&](std::size_t input) {
                        return std::cmp_equal(input, read_.axis.column) ||
                               Info(input).role == Role::kPosition;
                      }),
                  axis,
                  axis + 1);
    }
    words_ = std::move(chosen.words);
    records_ = std::move(chosen.records);
  }

  // ---- In which units.

  void ReadUnits() {
    RequireKnownUnit(table_, {read_.roles.target, ColumnUse::kTarget});
    if (const Header target = ReadHeader(Name(read_.roles.target));
        target.source == UnitSource::kAssumed) {
      said_.remarks.push_back(NameInRemark(Name(read_.roles.target)) +
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
    said_.remarks.push_back("no unit is read from " + ListOfNames(unread) +
                            ": " + WhyNoUnit(ReadHeader(unread.front())));
  }

  // ---- Which rows, and what is in them.

  void CheckColumns() {
    LeaveOutInputsThatCostRows(
        table_, selection_, read_.passes, read_.roles.target, &inputs_, &said_);
    std::vector<ColumnInUse> columns = {
        {read_.roles.target, ColumnUse::kTarget}};
    for (const std::size_t input : inputs_) {
      columns.push_back({input, ColumnUse::kInput});
    }
    for (const auto& [column, use] :
         {std::pair(read_.roles.group, ColumnUse::kGroup),
          {read_.roles.weight, ColumnUse::kWeight}}) {
      if (column == kNoColumn) continue;
      columns.push_back({static_cast<std::size_t>(column), use});
    }
    RefuseMixedDecimals(table_, columns);
    KeptRows kept =
        CheckCells(table_, columns, read_.passes, selection_.missing);
    if (!kept.first_missing.empty()) {
      const std::size_t dropped = kept.num_passed - kept.rows.size();
      // Readings without a target still run through a map's filters.
      said_.remarks.push_back(
          std::to_string(dropped) + " of " + std::to_string(kept.num_passed) +
          (dropped == 1 ? " rows is " : " rows are ") +
          (selection_.only_to_judge ? "not judged" : "dropped") +
          " for missing cells; the first: " + kept.first_missing);
    }
    parts_.rows = std::move(kept.rows);
  }

  void TakeTarget() {
    parts_.target = Info(read_.roles.target);
    parts_.target_values =
        ValuesOfRows(table_.At(read_.roles.target), parts_.rows);
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
      said_.remarks.push_back(std::move(*remark));
    }
    const double first = parts_.target_values(0);
    if (!(parts_.target_values.array() == first).all()) return;
    ThrowUnusable(
        table_,
        "target " + QuotedName(Name(read_.roles.target)) +
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
    if (read_.roles.weight == kNoColumn) return;
    parts_.weights =
        WeightsOf(table_, table_.At(read_.roles.weight), parts_.rows);
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
      if (!idle.how.empty()) said_.ReportIdle(Name(input), idle);
      if (idle.dead && !selection_.keep_dead) continue;
      parts_.inputs.push_back(Info(input));
      if (!idle.dead && !selection_.only_to_judge && IsRepeated(input)) {
        parts_.inputs.pop_back();
        continue;
      }
      ++used;
    }
    if (used == 0 && !inputs_.empty()) ThrowNoInputs(table_, said_.dropped);
    parts_.input_values.conservativeResize(Eigen::NoChange, used);
    if (auto remark = LikelyFahrenheit(parts_.inputs, parts_.input_values)) {
      said_.remarks.push_back(std::move(*remark));
    }
  }

  // Whether the last input says once more what another says, and is left out:
  // a map would share its weight between them by chance.
  bool IsRepeated(std::size_t input) {
    RepeatedInputs::Found found = repeated_.Look(parts_);
    std::ranges::move(found.remarks, std::back_inserter(said_.remarks));
    if (found.repeats.empty()) return false;
    const std::string why =
        "repeats " + NameInRemark(found.repeats) + " value for value";
    if (said_.IsNamed(Name(input))) {
      said_.remarks.push_back("input " + NameInRemark(Name(input)) + " " + why +
                              "; both are kept");
      return false;
    }
    said_.LeaveOutUnlessNamed(Name(input), why);
    return true;
  }

  // Of rows left out, the log keeps what else they hold.
  std::span<const ColumnFault> BlankedInLog() const {
    if (selection_.faults != FaultPolicy::kDropRows) return {};
    return faults_;
  }

  Eigen::Index NumSessions() const {
    return static_cast<Eigen::Index>(read_.found.sessions.labels.size());
  }

  std::vector<Eigen::Index> SessionOfRows() const {
    std::vector<Eigen::Index> sessions;
    for (const Eigen::Index row : parts_.rows) {
      sessions.push_back(read_.found.sessions.codes[std::ranges::lower_bound(
                                                        read_.log_rows, row) -
                                                    read_.log_rows.begin()]);
    }
    return sessions;
  }

  void RemarkOnUnits(const std::vector<Eigen::Index>& starts) {
    for (std::size_t i = 0; i < parts_.inputs.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      auto remark = OtherUnitInSession(
          parts_.inputs[i], parts_.input_values.col(column), starts);
      if (remark) said_.remarks.push_back(*std::move(remark));
    }
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
    if (!read_.repeated_rows.empty()) {
      faults_.insert(faults_.begin(),
                     {.kind = FaultKind::kRepeated,
                      .rows = read_.repeated_rows,
                      .of_cells = true});
    }
    if (selection_.faults != FaultPolicy::kDropRows) {
      for (const ColumnFault& fault : faults_) {
        if (std::string doubt = DoubtOfRows(fault, measured); !doubt.empty()) {
          said_.doubts.push_back(std::move(doubt));
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

  // And the faults of these.
  void LeaveOutUseless(const std::vector<UselessInput>& useless) {
    std::vector<bool> left_out(parts_.inputs.size(), false);
    for (const UselessInput& one : useless) {
      const auto at = static_cast<std::size_t>(one.input);
      const std::string& name = parts_.inputs[at].name;
      if (left_out[at] || (said_.IsNamed(name) && !one.even_named)) continue;
      left_out[at] = true;
      said_.LeaveOut(name, one.why, one.behind);
    }
    if (std::ranges::count(left_out, true) == 0) return;
    if (std::ranges::count(left_out, false) == 0) {
      ThrowNoInputs(table_, said_.dropped);
    }
    std::erase_if(faults_, [&](const ColumnFault& fault) {
      return fault.input >= 0 && left_out[fault.input];
    });
    const std::vector<Eigen::Index> places = LeaveOutInputs(left_out, &parts_);
    for (ColumnFault& fault : faults_) {
      if (fault.input < 0) continue;
      fault.input = places[fault.input];
    }
  }

  // Rows of several machines, tools or directions, which err differently.
  void LookForParts() {
    for (PartingRemark& remark :
         FindParts(table_,
                   words_,
                   parts_,
                   NumSessions() > 1 ? SessionOfRows()
                                     : std::vector<Eigen::Index>())) {
      if (remark.is_doubt) said_.doubts.push_back(remark.text);
      said_.remarks.push_back(std::move(remark.text));
    }
  }

  const CsvTable& table_;
  const DatasetSelection& selection_;
  ReadTable read_;
  DatasetRemarks said_;
  std::vector<std::size_t> inputs_;  // columns of the table
  Dataset::Parts parts_;
  RepeatedInputs repeated_;
  std::vector<ColumnFault> faults_;
  std::vector<std::size_t> words_;  // columns that name things
  std::vector<std::size_t> records_;
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
