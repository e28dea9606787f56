#include "data/measurements/dataset.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "data/argument_name.h"
#include "data/column_words.h"
#include "data/columns.h"
#include "data/measurements/clock/date_time.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_roles.h"
#include "data/text.h"

namespace errmap::data {
namespace {

[[noreturn]] void ThrowInvalid(const std::string& what) {
  throw std::invalid_argument("errmap::data::Dataset: " + what);
}

void CheckSize(const char* what, Eigen::Index found, Eigen::Index expected) {
  if (found == expected) return;
  ThrowInvalid(std::string(what) + ": found " + std::to_string(found) +
               ", expected " + std::to_string(expected));
}

void CheckGroups(const Grouping& groups, Eigen::Index num_rows) {
  const auto num_codes = static_cast<Eigen::Index>(groups.codes.size());
  const auto num_labels = static_cast<Eigen::Index>(groups.labels.size());
  if (groups.column.empty()) {
    CheckSize("group codes without a group column", num_codes, 0);
    CheckSize("group labels without a group column", num_labels, 0);
    return;
  }
  CheckSize("group codes", num_codes, num_rows);
  for (const Eigen::Index code : groups.codes) {
    if (code < 0 || code >= num_labels) {
      ThrowInvalid("group code " + std::to_string(code) +
                   " is outside the labels 0.." +
                   std::to_string(num_labels - 1));
    }
  }
}

void CheckLog(const SessionLog& log,
              const std::vector<Eigen::Index>& log_rows,
              Eigen::Index num_inputs,
              Eigen::Index num_rows) {
  const Eigen::Index in_log = log.time.size();
  if (log.input_values.size() != 0) {
    CheckSize(
        "columns of log.input_values", log.input_values.cols(), num_inputs);
    CheckSize("rows of log.input_values", log.input_values.rows(), in_log);
  }
  if (!log.time.allFinite()) {
    ThrowInvalid("log.time has a value that is not finite");
  }
  const auto check_codes = [](const char* what,
                              const std::vector<Eigen::Index>& codes,
                              Eigen::Index expected,
                              Eigen::Index limit) {
    CheckSize(what, static_cast<Eigen::Index>(codes.size()), expected);
    for (const Eigen::Index code : codes) {
      if (code >= 0 && code < limit) continue;
      ThrowInvalid(std::string(what) + ": " + std::to_string(code) +
                   " is outside 0.." + std::to_string(limit - 1));
    }
  };
  const auto sessions = static_cast<Eigen::Index>(log.sessions.labels.size());
  check_codes("log.sessions.codes", log.sessions.codes, in_log, sessions);
  check_codes("log.first_rows", log.first_rows, sessions, in_log);
  check_codes("log_rows", log_rows, num_rows, in_log);
}

// Inputs that are the log's stand in it row by row.
void CheckAreAllRows(const std::vector<Eigen::Index>& log_rows) {
  for (std::size_t i = 0; i < log_rows.size(); ++i) {
    if (log_rows[i] == static_cast<Eigen::Index>(i)) continue;
    ThrowInvalid("log_rows: found " + std::to_string(log_rows[i]) + " at " +
                 std::to_string(i) + ", and input_values are the log's");
  }
}

// Numbers come out sorted and each with its shortest text.
Grouping GroupByNumber(const std::string& column,
                       const ColumnValues& values,
                       const std::vector<Eigen::Index>& rows) {
  // Negative zero would compare equal to zero, yet be written "-0".
  const auto value_of = [&](Eigen::Index row) { return values[row] + 0.0; };
  std::map<double, Eigen::Index> code_of;
  for (const Eigen::Index row : rows) code_of.emplace(value_of(row), 0);
  Grouping groups{.column = column};
  for (auto& [value, code] : code_of) {
    code = static_cast<Eigen::Index>(groups.labels.size());
    groups.labels.push_back(CsvNumber(value));
  }
  groups.codes.reserve(rows.size());
  for (const Eigen::Index row : rows) {
    groups.codes.push_back(code_of.at(value_of(row)));
  }
  return groups;
}

// Texts, numbers among them or not, in order of appearance.
Grouping GroupByText(const CsvTable& table,
                     const CsvColumn& column,
                     const std::vector<Eigen::Index>& rows) {
  const auto [labels, codes] = LabelsOf(table, column, rows, kNoLimit);
  return {.column = column.name,
          .labels = labels,
          .codes = {codes.begin(), codes.end()}};
}

Role RoleOf(const ColumnInfo& column) {
  return column.role == Role::kUnknown ? RoleByName(column) : column.role;
}

}  // namespace

std::string_view ToString(Alignment align) {
  return align == Alignment::kFirst ? "first" : "none";
}

std::string_view ToString(Role role) {
  constexpr auto kNames = std::to_array<std::string_view>(
      {"", "position", "sensor", "switch", "counter"});
  return NameOf(kNames, role);
}

bool IsPosition(const ColumnInfo& column) {
  return RoleOf(column) == Role::kPosition;
}

bool IsReadBySensor(const ColumnInfo& column) {
  const Role role = RoleOf(column);
  return role == Role::kSensor || role == Role::kSwitch;
}

Role RoleByName(const ColumnInfo& column) {
  if (NamesPosition(column.name)) return Role::kPosition;
  return IsSensor(column) ? Role::kSensor : Role::kCounter;
}

std::string_view ToString(MissingPolicy policy) {
  return policy == MissingPolicy::kError ? "error" : "drop-rows";
}

std::string_view ToString(FaultPolicy policy) {
  return policy == FaultPolicy::kKeep ? "keep" : "drop-rows";
}

std::string ValueText(const ColumnFilter& filter) {
  const auto* const number = std::get_if<double>(&filter.value);
  return number != nullptr ? CsvNumber(*number)
                           : std::get<std::string>(filter.value);
}

Dataset::Dataset(Parts parts) : parts_(std::move(parts)) {
  const Eigen::Index m = parts_.target_values.size();
  for (ColumnInfo& input : parts_.inputs) {
    if (input.role == Role::kUnknown) input.role = RoleByName(input);
  }
  CheckSize("columns of input_values", input_values().cols(), num_inputs());
  if (num_inputs() > 0) {
    CheckSize("rows of input_values", input_values().rows(), m);
  }
  if (!parts_.target_values.allFinite()) {
    ThrowInvalid("target_values has a value that is not finite");
  }
  if (!input_values().allFinite()) {
    ThrowInvalid("input_values has a value that is not finite");
  }
  if (parts_.weights.size() != 0) {
    CheckSize("weights", parts_.weights.size(), m);
    if (!parts_.weights.allFinite() || !(parts_.weights.array() > 0.0).all()) {
      ThrowInvalid("weights has a value that is not positive and finite");
    }
  }
  CheckGroups(parts_.groups, m);
  // Without inputs the shape still says how many rows there are.
  if (num_inputs() == 0) parts_.input_values.resize(m, 0);
  if (parts_.rows.empty()) {
    parts_.rows = AllRows(static_cast<std::size_t>(m));
  }
  CheckSize("rows", static_cast<Eigen::Index>(parts_.rows.size()), m);
  if (parts_.log != nullptr) {
    CheckLog(*parts_.log, parts_.log_rows, num_inputs(), m);
    if (reads_log()) CheckAreAllRows(parts_.log_rows);
  } else {
    CheckSize("log_rows without a log",
              static_cast<Eigen::Index>(parts_.log_rows.size()),
              0);
  }
}

std::vector<std::string> Dataset::InputNames() const {
  std::vector<std::string> names;
  for (const ColumnInfo& input : inputs()) names.push_back(input.name);
  return names;
}

std::vector<Eigen::Index> Dataset::session_codes() const {
  std::vector<Eigen::Index> codes;
  codes.reserve(parts_.log_rows.size());
  for (const Eigen::Index row : parts_.log_rows) {
    codes.push_back(parts_.log->sessions.codes[row]);
  }
  return codes;
}

Eigen::Index Dataset::num_sessions() const {
  const std::vector<Eigen::Index> codes = session_codes();
  return static_cast<Eigen::Index>(
      std::set<Eigen::Index>(codes.begin(), codes.end()).size());
}

Eigen::Index Dataset::FindInput(std::string_view name) const {
  for (std::size_t i = 0; i < parts_.inputs.size(); ++i) {
    if (parts_.inputs[i].name == name) return static_cast<Eigen::Index>(i);
  }
  return -1;
}

Dataset Dataset::SelectRows(const std::vector<Eigen::Index>& indices) const {
  for (const Eigen::Index index : indices) {
    if (index < 0 || index >= num_rows()) {
      throw std::invalid_argument(
          "errmap::data::Dataset::SelectRows: index " + std::to_string(index) +
          " is outside the rows 0.." + std::to_string(num_rows() - 1));
    }
  }
  Parts parts{.source = parts_.source,
              .inputs = parts_.inputs,
              .input_values = input_values()(indices, Eigen::all),
              .target = parts_.target,
              .target_values = parts_.target_values(indices),
              .groups = {.column = parts_.groups.column,
                         .labels = parts_.groups.labels},
              .align = parts_.align,
              .log = parts_.log};
  if (parts_.weights.size() != 0) parts.weights = parts_.weights(indices);
  parts.rows.reserve(indices.size());
  for (const Eigen::Index index : indices) {
    const auto i = static_cast<std::size_t>(index);
    parts.rows.push_back(parts_.rows[i]);
    if (has_groups()) parts.groups.codes.push_back(parts_.groups.codes[i]);
    if (parts_.log) parts.log_rows.push_back(parts_.log_rows[i]);
  }
  return {OfChecked{}, std::move(parts)};
}

Dataset Dataset::WithLog(std::shared_ptr<const SessionLog> log,
                         std::vector<Eigen::Index> log_rows) const {
  Parts parts = parts_;
  parts.input_values = input_values();
  parts.log = std::move(log);
  parts.log_rows = std::move(log_rows);
  return Dataset(std::move(parts));
}

Dataset Dataset::WithInputs(std::vector<ColumnInfo> inputs,
                            Eigen::MatrixXd input_values) const {
  Parts parts = parts_;
  parts.inputs = std::move(inputs);
  parts.input_values = std::move(input_values);
  parts.log = nullptr;
  parts.log_rows.clear();
  return Dataset(std::move(parts));
}

Dataset WithoutRows(const Dataset& dataset,
                    const std::vector<Eigen::Index>& rows) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < dataset.num_rows(); ++i) {
    if (!std::ranges::binary_search(rows, dataset.rows()[i])) {
      kept.push_back(i);
    }
  }
  return dataset.SelectRows(kept);
}

std::string WordFor(const Grouping& grouping) {
  if (grouping.column.empty()) return "session";
  const bool are_dates = std::all_of(
      grouping.labels.begin(), grouping.labels.end(), [](const auto& label) {
        const auto read = ParseDateTime(label);
        return read && read->has_date && !read->has_time;
      });
  if (are_dates && !grouping.labels.empty()) return "day";
  if (IsCalled(grouping.column, Word::kCycle)) return "cycle";
  if (IsCalled(grouping.column, Word::kDay)) return "day";
  const bool has_plural =
      grouping.column.find_first_of("_0123456789[](") == std::string::npos;
  return has_plural ? grouping.column : "group";
}

Grouping GroupByColumn(const CsvTable& table,
                       const std::string& column,
                       const std::vector<Eigen::Index>& rows) {
  const std::size_t index = RequireColumn(table, column, ArgumentName("group"));
  const CsvColumn& cells = table.columns[index];
  bool all_numbers = true;
  for (const Eigen::Index row : rows) {
    if (row < 0 || static_cast<std::size_t>(row) >= table.num_rows) {
      throw std::invalid_argument(
          "errmap::data::GroupByColumn: row " + std::to_string(row) +
          " is outside the rows 0.." + std::to_string(table.num_rows - 1));
    }
    if (!std::isnan(cells.values[row])) continue;
    all_numbers = false;
    RefuseMissingCell(
        table, {index, ColumnUse::kGroup}, static_cast<std::size_t>(row));
  }
  return all_numbers ? GroupByNumber(column, cells.values, rows)
                     : GroupByText(table, cells, rows);
}

Eigen::VectorXd NumericColumn(const CsvTable& table,
                              const std::string& column,
                              MissingPolicy missing,
                              std::vector<Eigen::Index>* rows) {
  const std::size_t index =
      RequireColumn(table, column, ArgumentName("column"));
  const ColumnInUse used{index, ColumnUse::kOther};
  RequireNumbers(table, used);
  RefuseMixedDecimals(table, {used});
  KeptRows kept = CheckCells(
      table, {used}, std::vector<bool>(table.num_rows, true), missing);
  Eigen::VectorXd values = ValuesOfRows(table.columns[index], kept.rows);
  if (rows != nullptr) *rows = std::move(kept.rows);
  return values;
}

}  // namespace errmap::data
