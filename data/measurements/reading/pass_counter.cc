#include "data/measurements/reading/pass_counter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/measurements/column_roles.h"
#include "data/units.h"

namespace errmap::data {
namespace {

using Eigen::Index;

bool NumbersPasses(const CsvColumn& column,
                   const std::vector<Index>& rows,
                   const Motion& motion) {
  double first = std::nan("");
  double before = std::nan("");
  Index counted_on = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double value = column.values[static_cast<std::size_t>(rows[i])];
    if (value != std::floor(value)) return false;  // NaN, too
    if (i == 0) {
      first = value;
    } else if (motion.passes[i] == motion.passes[i - 1]) {
      if (value != before) return false;
    } else if (value == before + 1.0) {
      ++counted_on;
    } else if (value != first) {
      return false;
    }
    before = value;
  }
  return 2 * counted_on >= motion.num_passes;
}

}  // namespace

std::ptrdiff_t PassCounter(const CsvTable& table,
                           const DatasetSelection& selection,
                           std::size_t target,
                           const std::vector<Index>& rows,
                           const Motion& motion) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const CsvColumn& column = table.columns[i];
    if (i != target && !column.is_text() &&
        UnitOfColumn(column.name).symbol.empty() &&
        std::ranges::find(selection.inputs, column.name) ==
            selection.inputs.end() &&
        column.name != selection.session &&
        !CountsCycles({.name = column.name, .unit = {}}) &&
        NumbersPasses(column, rows, motion)) {
      return static_cast<std::ptrdiff_t>(i);
    }
  }
  return -1;
}

}  // namespace errmap::data
