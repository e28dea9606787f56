#include "data/measurements/builders/inputs_in_use.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>

#include "data/measurements/builders/idle_inputs.h"
#include "data/measurements/column_checks.h"

namespace errmap::data {

using Eigen::Index;

ChosenInputs ChooseInputsAsRead(const CsvTable& table,
                                const DatasetSelection& selection,
                                const ReadTable& read,
                                DatasetRemarks* said) {
  DatasetSelection with_axis = selection;
  // An axis by its values is not an error, whatever its unit.
  if (with_axis.position.empty()) with_axis.position = read.position;
  ChosenInputs chosen = ChooseInputs(table, with_axis, read.roles, read.found);
  std::ranges::move(chosen.dropped, std::back_inserter(said->dropped));
  const auto leave_out = [&](std::size_t column, const std::string& why) {
    const std::string& name = table.At(column).name;
    const auto found = std::ranges::find(chosen.inputs, column);
    if (found == chosen.inputs.end() || said->IsNamed(name)) return;
    chosen.inputs.erase(found);
    said->LeaveOutUnlessNamed(name, why);
  };
  const std::string axis = NameInRemark(read.position);
  // Where a position was measured is known after the fact only.
  for (const std::size_t column : read.axis.measured) {
    leave_out(column,
              read.position.empty()
                  ? "reads the position, which holds the error"
                  : "reads the position that " + axis + " commands");
  }
  for (const std::size_t column : read.axis.held) {
    leave_out(column, "reads an axis that stands");
  }
  for (const std::size_t column : read.axis.numbers) {
    leave_out(column, "numbers the positions of " + axis);
  }
  for (const Counter& counter : read.counters) {
    if (counter.counts == Counted::kElapsed) continue;
    leave_out(counter.column, std::string(ToString(counter.counts)));
  }
  for (const std::size_t column : read.date_parts) {
    leave_out(column, "is a part of the date");
  }
  said->Add(std::move(chosen.remarks));
  return chosen;
}

namespace {

// Says why, and leaves it out, where an input would cost rows.
bool CostsRows(const CsvTable& table,
               const CsvColumn& column,
               const CsvColumn& target,
               const std::vector<bool>& passes,
               bool keep_dead,
               DatasetRemarks* said) {
  constexpr Index kFewestRowsToTell = 12;
  constexpr Index kFewest = 10;  // percent
  Index num_rows = 0;
  std::vector<Index> with_numbers;
  for (std::size_t row = 0; row < table.num_rows; ++row) {
    if (!passes[row] || target.TextAt(row) != nullptr) continue;
    ++num_rows;
    if (column.TextAt(row) == nullptr) {
      with_numbers.push_back(static_cast<Index>(row));
    }
  }
  if (num_rows < kFewestRowsToTell) return false;
  if (100 * std::ssize(with_numbers) < kFewest * num_rows) {
    said->LeaveOutUnlessNamed(column.name,
                              "has a number in " +
                                  std::to_string(with_numbers.size()) + " of " +
                                  std::to_string(num_rows) + " rows");
    return true;
  }
  const IdleInput idle = HowIdle(ValuesOfRows(column, with_numbers));
  if (!idle.dead || keep_dead) return false;
  said->ReportIdle(column.name, idle);
  return true;
}

}  // namespace

void LeaveOutInputsThatCostRows(const CsvTable& table,
                                const DatasetSelection& selection,
                                const std::vector<bool>& passes,
                                std::size_t target,
                                std::vector<std::size_t>* inputs,
                                DatasetRemarks* said) {
  if (selection.missing != MissingPolicy::kDropRows ||
      selection.only_to_judge) {
    return;
  }
  std::erase_if(*inputs, [&](std::size_t input) {
    const CsvColumn& column = table.At(input);
    return !column.exceptions.empty() && !said->IsNamed(column.name) &&
           CostsRows(table,
                     column,
                     table.At(target),
                     passes,
                     selection.keep_dead,
                     said);
  });
}

void SetRoles(Dataset::Parts* parts) {
  const Eigen::MatrixXd* values = &parts->input_values;
  if (values->cols() == 0 && parts->log) values = &parts->log->input_values;
  for (std::size_t i = 0; i < parts->inputs.size(); ++i) {
    ColumnInfo& input = parts->inputs[i];
    if (input.role != Role::kUnknown) continue;
    input.role = RoleByName(input);
    if (input.role == Role::kSensor && input.unit.symbol.empty() &&
        HasTwoValues(values->col(static_cast<Index>(i)))) {
      input.role = Role::kSwitch;
    }
  }
}

void DescribeInputs(const CsvTable& table,
                    const Dataset::Parts& parts,
                    const std::vector<std::size_t>& records,
                    const DatasetRemarks& said,
                    Reading* reading) {
  for (const DroppedColumn& column : said.dropped) {
    reading->left_out.push_back({.column = column.column, .why = column.why});
    if (reading->position.column == column.column) reading->position = {};
  }
  for (const std::size_t column : records) {
    const std::string& name = table.At(column).name;
    if (reading->position.column == name) continue;
    reading->left_out.push_back(
        {.column = name, .why = "tells rows apart and measures nothing"});
  }
  for (const ColumnInfo& input : parts.inputs) {
    if (reading->position.column == input.name) continue;
    (input.role == Role::kPosition  ? reading->positions
     : input.role == Role::kSwitch  ? reading->switches
     : input.role == Role::kCounter ? reading->counters
                                    : reading->sensors)
        .push_back(input.name);
  }
}

void KeepRows(const std::vector<Index>& kept, Dataset::Parts* parts) {
  if (kept.size() == parts->rows.size()) return;
  std::vector<Index> rows;
  for (const Index i : kept) {
    rows.push_back(parts->rows[i]);
  }
  parts->rows = std::move(rows);
  parts->target_values = parts->target_values(kept).eval();
  parts->input_values = parts->input_values(kept, Eigen::all).eval();
  if (parts->weights.size() != 0) parts->weights = parts->weights(kept).eval();
}

std::vector<Index> LeaveOutInputs(const std::vector<bool>& left_out,
                                  Dataset::Parts* parts) {
  std::vector<Index> kept;
  std::vector<ColumnInfo> inputs;
  std::vector<Index> places(left_out.size(), -1);
  for (std::size_t i = 0; i < left_out.size(); ++i) {
    if (left_out[i]) continue;
    places[i] = static_cast<Index>(kept.size());
    kept.push_back(static_cast<Index>(i));
    inputs.push_back(std::move(parts->inputs[i]));
  }
  parts->inputs = std::move(inputs);
  if (kept.size() < left_out.size()) {
    parts->input_values = parts->input_values(Eigen::all, kept).eval();
  }
  return places;
}

}  // namespace errmap::data
