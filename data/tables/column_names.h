#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "data/csv.h"
#include "data/tables/number_columns.h"

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

/// Names of columns in a comment.
struct CommentNames {
  std::vector<std::string> names;  // as many as there are columns
  std::size_t line = 0;            // of the file; 0: there are none
};

/// Returns the names in the nearest comment above a table with as many names as
/// a row has cells ("# day;cycle;x_mm", "# columns: time;X"). Adds units if
/// another comment has them.
CommentNames FindNamesInComments(std::string_view above,
                                 char delimiter,
                                 const NumberColumns& columns);

}  // namespace errmap::data
