#pragma once

#include <cstddef>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// Whether a column has in each row a figure that sheets make of the cells of
/// others (two or more): their mean, least, most, range or standard deviation.
/// To rounding: it may miss by 5 % of how much the column varies.
bool IsRowFigure(const CsvTable& table,
                 std::size_t column,
                 const std::vector<std::size_t>& others);

}  // namespace errmap::data
