#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// Rows of other quantities among rows of errors: "T1 [degC]" where others have
/// the number of a run or a position.
struct InputRows {
  std::vector<std::ptrdiff_t> errors;  // rows
  /// For each name, the row that belongs to each row of errors.
  std::map<std::string, std::vector<std::ptrdiff_t>> inputs = {};
};

/// Finds them by the names in these columns. They belong to the rows above
/// them, or to those below if the table begins with one.
InputRows FindInputRows(const CsvTable& table,
                        const std::vector<std::size_t>& columns);

/// True if each cell of a column is a statistic of other cells in its row (two
/// or more): their mean, minimum, maximum, range or standard deviation. Because
/// of rounding, it may differ by 5 % of the column's variation.
bool IsRowFigure(const CsvTable& table,
                 std::size_t column,
                 const std::vector<std::size_t>& others);

}  // namespace errmap::data
