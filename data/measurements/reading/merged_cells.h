#pragma once

#include <cstddef>
#include <optional>

#include "data/csv.h"

namespace errmap::data {

/// A column as it was meant where a spreadsheet had merged cells: what names a
/// day, a cycle or a direction stands in the first row of each block, and the
/// others are empty. Nothing where the column has no name of such, half of its
/// cells or more are full, its first is, or others lack.
std::optional<CsvColumn> FilledDown(const CsvTable& table, std::size_t column);

}  // namespace errmap::data
