#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "data/csv.h"

namespace errmap::data {

// What the row is that a table ends in: its cells stand at the end of the
// columns, and table.num_rows does not count it yet.

/// True if its only cell is a remark: words, and not a time.
bool IsRemark(const CsvTable& table);
/// For a row without numbers, with this many cells: true if all are empty.
bool IsEmptyRow(const CsvTable& table, std::size_t cells);
/// For a row of words with this many cells: true if all but the first are
/// empty, in columns that held numbers so far.
bool HoldsRemarkAlone(const CsvTable& table, std::size_t cells);
/// True if its cells, fewer than in a row, may be totals below the rows
/// ("Mean,2.31"). A column that held numbers so far then holds a name.
bool AreTotals(const CsvTable& table);
/// For a row of words: true if it repeats these names; never if there are none.
bool RepeatsNames(const CsvTable& table, std::span<const std::string> names);
/// For a row of words: true if its cells are units.
bool HasUnits(const CsvTable& table, std::size_t width);
/// For a row of words with this many cells: true if they are in half of the
/// columns that held numbers so far.
bool HasWordsForNumbers(const CsvTable& table, std::size_t cells);

}  // namespace errmap::data
