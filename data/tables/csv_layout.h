#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "data/tables/cells/csv_cells.h"
#include "data/tables/csv_dialect.h"

namespace errmap::data {

/// Where in a file its table stands, and what its columns are called.
struct CsvLayout {
  /// (columns) As written; "" where a column has no name.
  std::vector<std::string> names;
  /// Cells of a row; less than the columns where no row reaches the last ones.
  std::size_t width = 0;
  std::size_t num_names = 0;         // columns that the line of names has
  std::size_t header_line = 0;       // 0: there are no names
  CsvCells::Position data{};         // where the rows begin
  std::vector<std::string> titles;   // lines above the table, as text
  std::vector<std::string> remarks;  // one line each, for people
};

/// The layout of the table from the cursor on, which stands at the first row
/// that is no comment.
///
/// The first row of the table is the first that has numbers where most rows
/// below have them. Its names are the nearest line above of the same number of
/// cells, none of them a number there; else such a comment; else there are
/// none. What stands further up are titles. Units below names stay to be read.
/// `text_above` is the file's text down to the cursor.
CsvLayout FindLayout(const CsvCells& cells,
                     const CsvDialect& dialect,
                     std::string_view text_above);

}  // namespace errmap::data
