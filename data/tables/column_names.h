#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// The columns of a table, without cells yet.
struct NamedColumns {
  std::vector<CsvColumn> columns;
  std::size_t num_named = 0;       // columns up to the last with a name
  std::vector<std::string> again;  // quoted: new names of those named twice
};

/// Makes columns of these names. An empty name becomes "column_3" by its
/// number, a repeated name "x_2". If all are empty, the numbers are the names.
NamedColumns NameColumns(const std::vector<std::string>& names);

}  // namespace errmap::data
