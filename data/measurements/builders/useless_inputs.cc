#include "data/argument_name.h"
#include "data/csv.h"
#include "data/measurements/builders/idle_inputs.h"
#include "data/measurements/builders/value_checks.h"
#include "data/measurements/column_roles.h"

namespace errmap::data {

using Eigen::Index;

std::vector<UselessInput> CountingInputs(const Dataset::Parts& parts,
                                         const std::vector<Index>& sessions) {
  std::vector<UselessInput> useless;
  for (Index i = 0; i < parts.input_values.cols(); ++i) {
    const ColumnInfo& input = parts.inputs[i];
    const auto values = parts.input_values.col(i);
    const bool counts = (CountsCycles(input) && CountsOn(values, sessions)) ||
                        (input.unit.symbol.empty() &&
                         AreNumbersThatNeverReturn(values, sessions)) ||
                        (input.unit.quantity != Quantity::kTemperature &&
                         !IsPosition(input) && NeverFalls(values));
    if (!counts) continue;
    useless.push_back(
        {.input = i,
         .why = "counts on from session to session",
         .behind = "; name it in " + ArgumentName("inputs") + " to use it"});
  }
  return useless;
}

std::vector<UselessInput> StuckInputs(const Dataset::Parts& parts,
                                      std::span<const ColumnFault> faults) {
  std::vector<UselessInput> useless;
  for (const ColumnFault& fault : faults) {
    if (fault.kind != FaultKind::kStuck || parts.rows.empty() ||
        fault.rows.back() != parts.rows.back()) {
      continue;
    }
    useless.push_back(
        {.input = fault.input,
         .why = "is dead (stuck at " + CsvNumber(fault.value) +
                " from data row " + std::to_string(fault.rows.front()) + " on)",
         .behind = "; " + ArgumentName("keep_dead") + " keeps it"});
  }
  return useless;
}

}  // namespace errmap::data
