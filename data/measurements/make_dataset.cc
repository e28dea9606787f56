// MakeDataset of data/measurements/dataset.h: which columns are used, and as
// what.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "data/measurements/column_checks.h"
#include "data/measurements/dataset.h"
#include "data/measurements/sessions.h"
#include "data/text.h"

namespace errmap::data {
namespace {

// The share of rows with one value from which an input counts as dead.
constexpr Eigen::Index kDeadPercent = 90;

constexpr std::ptrdiff_t kNone = -1;

// Which column serves as what, before any cell is looked at.
struct Roles {
  std::size_t target = 0;
  std::ptrdiff_t group = kNone;
  std::ptrdiff_t weight = kNone;
  std::vector<std::size_t> inputs;
};

[[noreturn]] void ThrowUnusable(const CsvTable& table,
                                const std::string& what) {
  throw InputError(PrintablePath(table.file) + ": " + what);
}

std::string NameInRemark(const std::string& name) {
  return Printable(name, name.max_size());
}

// Columns that number or date the rows; what no controller has at hand.
bool KeepsRecord(std::string_view name) {
  constexpr auto kNames = std::to_array<std::string_view>({"cycle",
                                                           "session",
                                                           "day",
                                                           "run",
                                                           "segment",
                                                           "record",
                                                           "index",
                                                           "row",
                                                           "id",
                                                           "sample"});
  return std::any_of(kNames.begin(),
                     kNames.end(),
                     [&](std::string_view known) {
                       return EqualsIgnoringCase(name, known);
                     }) ||
         StartsWithIgnoringCase(name, "time") ||
         StartsWithIgnoringCase(name, "truth");
}

// A column that nobody named: the index that spreadsheets and data frames
// write beside their rows, under an empty name or (once read and written again)
// as "Unnamed: 0".
bool IsUnnamed(const CsvColumn& column) {
  return !column.has_name || StartsWithIgnoringCase(column.name, "Unnamed:");
}

// True where every cell is empty, NA or NaN: a channel that was never logged.
bool IsAllMissing(const CsvColumn& column) {
  return column.is_text() &&
         std::all_of(column.texts.begin(), column.texts.end(), IsMissingText);
}

class DatasetBuilder {
 public:
  DatasetBuilder(const CsvTable& table, const DatasetSelection& selection)
      : table_(table), selection_(selection) {}

  PreparedDataset Build() {
    ChooseWeightAndTarget();
    ChooseGroup();
    ChooseRows();
    if (selection_.inputs.empty() && !selection_.only_to_judge) {
      ChooseDefaultInputs();
    } else {
      ChooseNamedInputs();
    }
    ReadUnits();
    CheckColumns();
    TakeTarget();
    TakeWeights();
    TakeInputs();
    LookForFaults();
    if (roles_.group != kNone) {
      parts_.groups = GroupByColumn(table_, Name(roles_.group), parts_.rows);
    }
    if (selection_.with_log) TakeLog();
    if (selection_.align == Alignment::kFirst) AlignTarget();
    parts_.source = table_.file;
    return {
        .dataset = Dataset(std::move(parts_)),
        .dropped = std::move(dropped_),
        .remarks = std::move(remarks_),
        .time_column = found_.time_column >= 0 ? Name(found_.time_column) : "",
        .faults = std::move(faults_)};
  }

 private:
  template <typename Index>
  const CsvColumn& Column(Index index) const {
    return table_.columns[static_cast<std::size_t>(index)];
  }
  template <typename Index>
  const std::string& Name(Index index) const {
    return Column(index).name;
  }
  ColumnInfo Info(std::size_t index) const {
    return {.name = Name(index), .unit = UnitOfColumn(Name(index))};
  }

  bool Is(std::ptrdiff_t role, std::size_t index) const {
    return role == static_cast<std::ptrdiff_t>(index);
  }

  bool IsFiltered(std::size_t index) const {
    return std::ranges::any_of(selection_.where, [&](const auto& filter) {
      return filter.column == Name(index);
    });
  }

  void Drop(std::size_t index, const std::string& why) {
    dropped_.push_back({.column = Name(index), .why = why});
  }

  // ---- Which columns.

  void ChooseWeightAndTarget() {
    if (!selection_.weight.empty()) {
      roles_.weight = static_cast<std::ptrdiff_t>(
          RequireColumn(table_, selection_.weight, "--weight"));
    }
    roles_.target = selection_.target.empty()
                        ? DefaultTarget()
                        : RequireColumn(table_, selection_.target, "--target");
    RequireNumbers(table_, {roles_.target, ColumnUse::kTarget});
    if (Is(roles_.weight, roles_.target)) {
      ThrowUnusable(table_,
                    "column " + QuotedName(Name(roles_.target)) +
                        " cannot be both the target and the weight; name "
                        "another with --weight");
    }
    if (roles_.weight != kNone) {
      RequireNumbers(
          table_,
          {static_cast<std::size_t>(roles_.weight), ColumnUse::kWeight});
    }
  }

  std::size_t DefaultTarget() const {
    std::vector<std::size_t> candidates;
    std::vector<std::string> names;
    std::vector<std::string> numeric_names;
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      if (!Column(i).is_text()) numeric_names.push_back(Name(i));
      if (Is(roles_.weight, i) || Name(i) == selection_.group ||
          !StartsWithIgnoringCase(Name(i), "error")) {
        continue;
      }
      candidates.push_back(i);
      names.push_back(Name(i));
    }
    if (candidates.empty()) {
      ThrowUnusable(
          table_,
          "no column's name starts with 'error'; name the measured error with "
          "--target (" +
              (numeric_names.empty()
                   ? "but no column holds numbers"
                   : "columns of numbers: " + ListOfNames(numeric_names)) +
              ")");
    }
    if (candidates.size() > 1) {
      ThrowUnusable(table_,
                    "several columns could be the target; name one with "
                    "--target: " +
                        ListOfNames(names));
    }
    return candidates.front();
  }

  void ChooseGroup() {
    if (!selection_.group.empty()) {
      roles_.group = static_cast<std::ptrdiff_t>(
          RequireColumn(table_, selection_.group, "--group"));
      if (Is(roles_.group, roles_.target)) {
        ThrowUnusable(table_,
                      "column " + QuotedName(selection_.group) +
                          " cannot be both the target and the group; name "
                          "another with --group");
      }
      return;
    }
    std::ptrdiff_t cycle = table_.Find("cycle");
    for (std::size_t i = 0; cycle == kNone && i < table_.columns.size(); ++i) {
      if (EqualsIgnoringCase(Name(i), "cycle")) {
        cycle = static_cast<std::ptrdiff_t>(i);
      }
    }
    if (cycle != kNone && !Is(cycle, roles_.target)) roles_.group = cycle;
  }

  // Those that may be used, and their sessions.
  void ChooseRows() {
    passes_ = RowsThatPass(table_, selection_.where);
    if (!selection_.with_log) return;
    for (std::size_t row = 0; row < passes_.size(); ++row) {
      if (passes_[row]) log_rows_.push_back(static_cast<Eigen::Index>(row));
    }
    found_ = FindSessions(table_, selection_, log_rows_);
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

  void ChooseNamedInputs() {
    const std::unordered_set<std::string> excluded = ExcludedNames();
    std::unordered_set<std::string> seen;
    for (const std::string& name : selection_.inputs) {
      const std::size_t index = RequireColumn(
          table_,
          name,
          selection_.only_to_judge ? "an input of the map" : "--inputs");
      if (!seen.insert(name).second) {
        ThrowUnusable(
            table_,
            "--inputs names " + QuotedName(name) + " twice; name it once");
      }
      if (index == roles_.target) {
        ThrowUnusable(table_,
                      QuotedName(name) +
                          " is the target and cannot be an input; leave it "
                          "out of --inputs");
      }
      if (excluded.contains(name)) {
        ThrowUnusable(table_,
                      QuotedName(name) +
                          " is named in --inputs and in --exclude; take it "
                          "out of one of them");
      }
      RequireNumbers(table_, {index, ColumnUse::kInput});
      roles_.inputs.push_back(index);
    }
  }

  std::unordered_set<std::string> ExcludedNames() const {
    for (const std::string& name : selection_.exclude) {
      RequireColumn(table_, name, "--exclude");
    }
    return {selection_.exclude.begin(), selection_.exclude.end()};
  }

  void ChooseDefaultInputs() {
    const std::unordered_set<std::string> excluded = ExcludedNames();
    const std::string target_stem = StemOfColumn(Name(roles_.target));
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      if (i == roles_.target || Is(roles_.group, i) || Is(roles_.weight, i) ||
          Is(found_.time_column, i) || Name(i) == found_.sessions.column ||
          KeepsRecord(Name(i)) || IsFiltered(i)) {
        continue;
      }
      const std::string name = NameInRemark(Name(i));
      if (excluded.contains(Name(i))) {
        had_candidates_ = had_candidates_ || !Column(i).is_text();
      } else if (IsUnnamed(Column(i))) {
        had_candidates_ = true;
        Drop(i, "has no name in the header");
        remarks_.push_back("column " + name +
                           " has no name in the header and is left out of the "
                           "inputs");
      } else if (NamesPosition(Name(i)) && Column(i).is_text()) {
        RefuseNumbersAsText(table_, Column(i));
      } else if (IsAllMissing(Column(i))) {
        Drop(i, "no number in any row");
        remarks_.push_back("input " + name +
                           " has no number in any row and is left out");
      } else if (Column(i).is_text()) {
        RefuseNumbersAsText(table_, Column(i));
        texts.push_back(Name(i));
      } else if (StemOfColumn(Name(i)) == target_stem) {
        had_candidates_ = true;
        Drop(i, "measures the target's quantity");
        remarks_.push_back("column " + name +
                           " measures the target's quantity and is left out; "
                           "name it in --inputs to use it");
      } else {
        roles_.inputs.push_back(i);
      }
    }
    if (!texts.empty()) {
      remarks_.push_back(
          (texts.size() == 1 ? "column " : "columns ") + ListOfNames(texts) +
          (texts.size() == 1 ? " holds text and is" : " hold text and are") +
          " left out of the inputs");
    }
    if (roles_.inputs.empty() && found_.time_column >= 0) {
      had_candidates_ = true;
      Drop(static_cast<std::size_t>(found_.time_column), "is the time");
    }
    if (roles_.inputs.empty() && had_candidates_) ThrowNoInputs();
  }

  [[noreturn]] void ThrowNoInputs() const {
    std::string what = "no input is left";
    for (std::size_t i = 0; i < dropped_.size(); ++i) {
      constexpr std::size_t kMostReasons = 3;
      if (i == kMostReasons) {
        what += "; and " + std::to_string(dropped_.size() - i) + " more";
        break;
      }
      what += (i == 0 ? ": " : "; ") + QuotedName(dropped_[i].column) + " " +
              dropped_[i].why;
    }
    ThrowUnusable(table_,
                  what +
                      "; name inputs with --inputs, or keep dead ones with "
                      "--keep-dead");
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
    for (const std::size_t input : roles_.inputs) {
      RequireKnownUnit(table_, {input, ColumnUse::kInput});
      if (ReadHeader(Name(input)).source == UnitSource::kUnread) {
        unread.push_back(Name(input));
      }
    }
    if (unread.empty()) return;
    remarks_.push_back("no unit is read from " + ListOfNames(unread) + ": " +
                       WhyNoUnit(ReadHeader(unread.front())));
  }

  // ---- Which rows, and what is in them.

  void CheckColumns() {
    std::vector<ColumnInUse> columns = {{roles_.target, ColumnUse::kTarget}};
    for (const std::size_t input : roles_.inputs) {
      columns.push_back({input, ColumnUse::kInput});
    }
    if (roles_.group != kNone) {
      columns.push_back(
          {static_cast<std::size_t>(roles_.group), ColumnUse::kGroup});
    }
    if (roles_.weight != kNone) {
      columns.push_back(
          {static_cast<std::size_t>(roles_.weight), ColumnUse::kWeight});
    }
    RefuseMixedDecimals(table_, columns);
    KeptRows kept = CheckCells(table_, columns, passes_, selection_.missing);
    if (!kept.remark.empty()) remarks_.push_back(kept.remark);
    parts_.rows = std::move(kept.rows);
  }

  void TakeTarget() {
    parts_.target = Info(roles_.target);
    parts_.target_values = ValuesOfRows(Column(roles_.target), parts_.rows);
    RequireSquares();
    if (selection_.only_to_judge) return;
    const double first = parts_.target_values(0);
    if (!(parts_.target_values.array() == first).all()) return;
    ThrowUnusable(
        table_,
        "target " + QuotedName(Name(roles_.target)) +
            (parts_.rows.size() == 1
                 ? " has a single row"
                 : " is constant (" + CsvNumber(first) + " in all " +
                       std::to_string(parts_.rows.size()) + " rows)") +
            ", so there is nothing to map; name another with --target");
  }

  // Every figure of a target is a sum of squares.
  void RequireSquares() const {
    constexpr double kMost = 1e100;
    constexpr double kLeast = 1e-100;
    Eigen::Index row = 0;
    const double largest = parts_.target_values.cwiseAbs().maxCoeff(&row);
    if (largest == 0.0 || (largest >= kLeast && largest <= kMost)) return;
    throw InputError(
        table_.Where(static_cast<std::size_t>(
                         parts_.rows[static_cast<std::size_t>(row)]),
                     Name(roles_.target)) +
        ": the largest target, " + CsvNumber(parts_.target_values[row]) +
        ", is no size between 1e-100 and 1e100, whose squares can be summed; "
        "correct it or choose another unit");
  }

  // Only the ratios of weights mean something. Their mean becomes 1, so that
  // weights which are all equal are none.
  void TakeWeights() {
    if (roles_.weight == kNone) return;
    const CsvColumn& column = Column(roles_.weight);
    parts_.weights = ValuesOfRows(column, parts_.rows);
    for (std::size_t i = 0; i < parts_.rows.size(); ++i) {
      const double weight = parts_.weights(static_cast<Eigen::Index>(i));
      if (weight > 0.0) continue;
      throw InputError(
          table_.Where(static_cast<std::size_t>(parts_.rows[i]), column.name) +
          ": weight " + CsvNumber(weight) +
          " is not positive; correct it or remove the row");
    }
    Eigen::Index least = 0;
    parts_.weights /= parts_.weights.maxCoeff();
    constexpr double kLeastShare = 1e-30;
    if (parts_.weights.minCoeff(&least) < kLeastShare) {
      const auto row = static_cast<std::size_t>(
          parts_.rows[static_cast<std::size_t>(least)]);
      throw InputError(table_.Where(row, column.name) + ": weight " +
                       CsvNumber(column.values[row]) +
                       " is less than 1e-30 of the largest; remove the row");
    }
    parts_.weights /= parts_.weights.mean();
  }

  void TakeInputs() {
    const Eigen::VectorXd& target = parts_.target_values;
    parts_.input_values.resize(target.size(),
                               static_cast<Eigen::Index>(roles_.inputs.size()));
    Eigen::Index used = 0;
    for (const std::size_t input : roles_.inputs) {
      // A dead column is overwritten by the next.
      parts_.input_values.col(used) = ValuesOfRows(Column(input), parts_.rows);
      const std::string dead = selection_.only_to_judge
                                   ? ""
                                   : DeadBecause(parts_.input_values.col(used));
      if (!dead.empty()) {
        ReportDead(input, dead);
        if (!selection_.keep_dead) continue;
      }
      parts_.inputs.push_back(Info(input));
      if (dead.empty() && !selection_.only_to_judge) NameRepeated(used);
      ++used;
    }
    if (used == 0 && !roles_.inputs.empty()) ThrowNoInputs();
    parts_.input_values.conservativeResize(Eigen::NoChange, used);
  }

  void TakeLog() {
    auto log = std::make_shared<SessionLog>();
    log->sessions = std::move(found_.sessions);
    log->time = std::move(found_.time);
    log->time_unit = std::move(found_.time_unit);
    // Both lists ascend, and the rows kept are among those of the log.
    auto at = log_rows_.begin();
    for (const Eigen::Index row : parts_.rows) {
      at = std::lower_bound(at, log_rows_.end(), row);
      parts_.log_rows.push_back(at - log_rows_.begin());
    }
    if (log_rows_ == parts_.rows) {
      log->input_values = std::move(parts_.input_values);
      parts_.input_values.resize(0, 0);
    } else {
      log->input_values = LoggedInputs();
      if (selection_.faults == FaultPolicy::kDropRows) BlankFaults(log.get());
    }
    log->first_rows = FirstRows(log->sessions, log->input_values);
    parts_.log = std::move(log);
  }

  // Of all rows, those that were dropped too.
  Eigen::MatrixXd LoggedInputs() const {
    Eigen::MatrixXd values(static_cast<Eigen::Index>(log_rows_.size()),
                           parts_.input_values.cols());
    for (Eigen::Index i = 0; i < values.cols(); ++i) {
      const std::string& name = parts_.inputs[static_cast<std::size_t>(i)].name;
      values.col(i) = ValuesOfRows(Column(table_.Find(name)), log_rows_);
    }
    return values;
  }

  // A reading that no machine made is none that a filter may run through.
  void BlankFaults(SessionLog* log) const {
    for (const ColumnFault& fault : faults_) {
      if (!fault.of_cells || fault.input < 0) continue;
      for (const Eigen::Index row : fault.rows) {
        const auto at = std::ranges::lower_bound(log_rows_, row);
        log->input_values(at - log_rows_.begin(), fault.input) =
            std::numeric_limits<double>::quiet_NaN();
      }
    }
  }

  void AlignTarget() {
    parts_.align = Alignment::kFirst;
    const SessionLog& log = *parts_.log;
    std::vector<double> first(log.sessions.labels.size());
    // Backwards, so that the first row has the last word.
    const auto session_of = [&](std::size_t i) {
      return static_cast<std::size_t>(
          log.sessions.codes[static_cast<std::size_t>(parts_.log_rows[i])]);
    };
    for (std::size_t i = parts_.rows.size(); i-- > 0;) {
      first[session_of(i)] = parts_.target_values[static_cast<Eigen::Index>(i)];
    }
    for (std::size_t i = 0; i < parts_.rows.size(); ++i) {
      parts_.target_values[static_cast<Eigen::Index>(i)] -=
          first[session_of(i)];
    }
    remarks_.push_back("the first value of each session is taken off " +
                       QuotedName(parts_.target.name) +
                       " (--align first): the map tells the change since");
  }

  Eigen::Index NumSessions() const {
    return static_cast<Eigen::Index>(found_.sessions.labels.size());
  }

  // Before anything is made of the rows.
  void LookForFaults() {
    faults_ = FindColumnFaults({.target = parts_.target,
                                .target_values = parts_.target_values,
                                .inputs = parts_.inputs,
                                .input_values = parts_.input_values,
                                .rows = parts_.rows,
                                .num_sessions = NumSessions()});
    if (selection_.faults != FaultPolicy::kDropRows) return;
    const std::vector<Eigen::Index> faulty = RowsOfCellFaults(faults_);
    std::vector<Eigen::Index> kept;
    for (std::size_t i = 0; i < parts_.rows.size(); ++i) {
      if (!std::ranges::binary_search(faulty, parts_.rows[i])) {
        kept.push_back(static_cast<Eigen::Index>(i));
      }
    }
    if (kept.size() == parts_.rows.size()) return;
    std::vector<Eigen::Index> rows;
    for (const Eigen::Index i : kept) {
      rows.push_back(parts_.rows[static_cast<std::size_t>(i)]);
    }
    parts_.rows = std::move(rows);
    parts_.target_values = parts_.target_values(kept).eval();
    parts_.input_values = parts_.input_values(kept, Eigen::all).eval();
    if (parts_.weights.size() != 0)
      parts_.weights = parts_.weights(kept).eval();
  }

  void ReportDead(std::size_t input, const std::string& how) {
    const std::string why = "is dead (" + how + ")";
    if (!selection_.keep_dead) Drop(input, why);
    remarks_.push_back("input " + NameInRemark(Name(input)) + " " + why +
                       (selection_.keep_dead
                            ? " and is kept"
                            : " and is left out; --keep-dead keeps it"));
  }

  // Says how a dead column is dead, "" where it lives.
  static std::string DeadBecause(
      const Eigen::Ref<const Eigen::VectorXd>& values) {
    // The only value that more than half of the rows can have (Boyer and
    // Moore, 1981): it outlasts all others that cancel it one for one.
    double candidate = 0.0;
    Eigen::Index lead = 0;
    for (const double value : values) {
      if (lead == 0) candidate = value;
      lead += value == candidate ? 1 : -1;
    }
    const Eigen::Index count = (values.array() == candidate).count();
    const Eigen::Index m = values.size();
    if (100 * count < kDeadPercent * m) return "";
    return CsvNumber(candidate + 0.0) + " in " +
           (count == m ? "all " : std::to_string(count) + " of ") +
           std::to_string(m) + " rows";
  }

  // A remark where input `used`, the last so far, repeats an earlier one or
  // the target. Columns are met by their hash, so that many stay cheap.
  void NameRepeated(Eigen::Index used) {
    const auto values = parts_.input_values.col(used);
    const std::string name =
        NameInRemark(parts_.inputs[static_cast<std::size_t>(used)].name);
    if (values == parts_.target_values) {
      remarks_.push_back("input " + name + " repeats the target " +
                         NameInRemark(parts_.target.name) +
                         " value for value; --exclude " + name +
                         " leaves it out");
    }
    std::vector<Eigen::Index>& alike = inputs_by_hash_[Hash(values)];
    for (const Eigen::Index other : alike) {
      if (parts_.input_values.col(other) != values) continue;
      remarks_.push_back(
          "input " + name + " repeats " +
          NameInRemark(parts_.inputs[static_cast<std::size_t>(other)].name) +
          " value for value; both are kept");
      return;
    }
    alike.push_back(used);
  }

  static std::uint64_t Hash(const Eigen::Ref<const Eigen::VectorXd>& values) {
    // Multiplicative mixing by 2^64 / golden ratio; zeros of both signs agree.
    std::uint64_t hash = 0;
    for (const double value : values) {
      hash ^= std::bit_cast<std::uint64_t>(value + 0.0);
      hash *= 0x9E3779B97F4A7C15U;
      hash ^= hash >> 32U;
    }
    return hash;
  }

  const CsvTable& table_;
  const DatasetSelection& selection_;
  Roles roles_;
  bool had_candidates_ = false;  // numeric columns that might have been inputs
  Dataset::Parts parts_;
  std::vector<bool> passes_;            // (rows of the table)
  std::vector<Eigen::Index> log_rows_;  // rows that may be used
  FoundSessions found_;                 // of those
  std::unordered_map<std::uint64_t, std::vector<Eigen::Index>> inputs_by_hash_;
  std::vector<DroppedColumn> dropped_;
  std::vector<std::string> remarks_;
  std::vector<ColumnFault> faults_;
};

}  // namespace

PreparedDataset MakeDataset(const CsvTable& table,
                            const DatasetSelection& selection) {
  return DatasetBuilder(table, selection).Build();
}

}  // namespace errmap::data
