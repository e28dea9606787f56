#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "data/tables/cells/csv_cells.h"
#include "data/tables/csv_dialect.h"

namespace errmap::data {

/// The place of the table in a file, and the names of its columns.
struct CsvLayout {
  /// (columns) As written; "" if a column has no name.
  std::vector<std::string> names;
  /// Cells of a row; less than the number of columns if no row reaches the last
  /// ones.
  std::size_t width = 0;
  std::size_t num_names = 0;         // columns that the line of names has
  std::size_t header_line = 0;       // 0: there are no names
  CsvCells::Position data{};         // where the rows begin
  std::vector<std::string> titles;   // lines above the table, as text
  std::vector<std::string> remarks;  // one line each, for people
};

/// Returns the layout of the table from the cursor, which is at the first row
/// that is not a comment. The first row of the table is the first one with
/// numbers where most rows below have numbers. The names are in the nearest
/// line above with as many cells and no number there, else in such a comment,
/// else there are none. Lines further up are titles. Units below the names are
/// read later. `text_above` is the file's text up to the cursor.
CsvLayout FindLayout(const CsvCells& cells,
                     const CsvDialect& dialect,
                     std::string_view text_above);

}  // namespace errmap::data
