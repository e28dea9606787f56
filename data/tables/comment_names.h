#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "data/tables/number_columns.h"

namespace errmap::data {

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
