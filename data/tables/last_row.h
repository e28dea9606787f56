#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "data/csv.h"

namespace errmap::data {

// What the row is that a table ends in: its cells stand at the end of the
// columns, and table.num_rows does not count it yet.

/// Whether its only cell is a remark: words, and no time.
bool IsRemark(const CsvTable& table);
/// Of a row without numbers, of so many cells: whether all are empty.
bool IsEmptyRow(const CsvTable& table, std::size_t cells);
/// Of a row of words of so many cells: whether all but the first are empty, and
/// numbers stood there so far.
bool HoldsRemarkAlone(const CsvTable& table, std::size_t cells);
/// Whether its cells, fewer than a row has, may be totals below the rows
/// ("Mean,2.31"): a name where numbers stood so far.
bool AreTotals(const CsvTable& table);
/// Of a row of words: whether it repeats these names; never where there are
/// none.
bool RepeatsNames(const CsvTable& table, std::span<const std::string> names);
/// Of a row of words: whether it has units.
bool HasUnits(const CsvTable& table, std::size_t width);
/// Of a row of words of so many cells: whether they stand where numbers stood
/// so far, in half of those columns.
bool HasWordsForNumbers(const CsvTable& table, std::size_t cells);

}  // namespace errmap::data
