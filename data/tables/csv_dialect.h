#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "data/tables/cells/csv_cells.h"

namespace errmap::data {

/// How a file separates its cells and writes its numbers.
struct CsvDialect {
  /// Tab, `;`, `|` or `,`; a blank if blanks separate the cells; or
  /// CsvCells::kNoDelimiter.
  char delimiter = CsvCells::kNoDelimiter;
  bool decimal_comma = false;   // a comma may stand for a decimal point
  bool decimal_points = false;  // numbers have points
};

/// A row at the beginning of a file.
struct CsvRecord {
  std::vector<std::string> cells = {};
  CsvCells::Position start;
};

/// Limit that bounds memory, above the number of columns of any measurement.
inline constexpr std::size_t kMostCsvColumns = 1U << 16U;

/// Returns the file's first rows from the cursor, which does not move; skips
/// comments and blank lines. Ends early if a quote is never closed, or after
/// much text. Throws InputError if a row has more cells than kMostCsvColumns.
std::vector<CsvRecord> FirstRecords(CsvCells cells);

/// Returns the most frequent number of cells in these rows from `first` on; in
/// a tie, the later one. A number above 1 is preferred if a quarter of the rows
/// have it. 1 if there are no rows.
std::size_t UsualWidth(const std::vector<CsvRecord>& records,
                       std::size_t first);

/// Returns the dialect in which most rows at the cursor have the same number of
/// cells, and most of their cells are numbers, times or empty.
CsvDialect FindDialect(const CsvCells& cells);

}  // namespace errmap::data
