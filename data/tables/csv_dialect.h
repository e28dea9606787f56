#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "data/tables/cells/csv_cells.h"

namespace errmap::data {

/// How a file parts its cells and writes its numbers.
struct CsvDialect {
  /// Tab, `;`, `|` or `,`; ' ' where blanks part the cells; or
  /// CsvCells::kNoDelimiter.
  char delimiter = CsvCells::kNoDelimiter;
  bool decimal_comma = false;   // a comma may stand for a decimal point
  bool decimal_points = false;  // numbers have points
};

/// A row of a file's beginning.
struct CsvRecord {
  std::vector<std::string> cells;
  CsvCells::Position start;
};

/// More columns than any measurement has, and than memory should be kept for.
inline constexpr std::size_t kMostCsvColumns = 1U << 16U;

/// The file's first rows from the cursor on, which stays; comments and blank
/// lines are passed over. They end early where a quote is never closed, or once
/// they are much text. Throws InputError where one has more cells than
/// kMostCsvColumns.
std::vector<CsvRecord> FirstRecords(CsvCells cells);

/// The most frequent number of cells in these rows from `first` on; of two the
/// later; more than 1 where a quarter of the rows have as many. 1 where there
/// is no row.
std::size_t UsualWidth(const std::vector<CsvRecord>& records,
                       std::size_t first);

/// The dialect by which most of the rows at the cursor have the same number of
/// cells, and most of their cells are numbers, times or nothing.
CsvDialect FindDialect(const CsvCells& cells);

}  // namespace errmap::data
