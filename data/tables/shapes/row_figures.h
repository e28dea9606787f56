#pragma once

#include <cstddef>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// True if each cell of a column is a statistic of other cells in its row (two
/// or more): their mean, minimum, maximum, range or standard deviation. Because
/// of rounding, it may differ by 5 % of the column's variation.
bool IsRowFigure(const CsvTable& table,
                 std::size_t column,
                 const std::vector<std::size_t>& others);

}  // namespace errmap::data
