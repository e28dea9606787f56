#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "data/tables/number_columns.h"

namespace errmap::data {

/// Names of columns that a comment has.
struct CommentNames {
  std::vector<std::string> names;  // as many as there are columns
  std::size_t line = 0;            // of the file; 0: there are none
};

/// Those of the nearest comment in the text above a table that has as many as
/// a row has cells ("# day;cycle;x_mm", "# columns: time;X"), with the units of
/// a comment that has those.
CommentNames FindNamesInComments(std::string_view above,
                                 char delimiter,
                                 const NumberColumns& columns);

}  // namespace errmap::data
