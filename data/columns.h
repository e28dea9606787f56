#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// A column of numbers; NaN is an empty cell.
CsvColumn NumberColumn(const std::string& name, std::vector<double> values);

/// A column that has words[code] in each row.
CsvColumn WordColumn(const std::string& name,
                     const std::vector<std::ptrdiff_t>& codes,
                     std::vector<std::string> words);

/// The cells of these rows of a column in this order, each as often as it is
/// named; -1 is an empty cell.
CsvColumn TakeRows(const CsvColumn& column,
                   const std::vector<std::ptrdiff_t>& rows);

/// Rows of a table, in this order; each keeps its line of the file.
CsvTable TakeRows(const CsvTable& table,
                  const std::vector<std::ptrdiff_t>& rows);

/// The cells of `more` below those of `column`.
void AppendCells(const CsvColumn& more, CsvColumn* column);

/// Drops the texts that no cell has.
void DropUnusedTexts(CsvColumn* column);

/// The distinct texts of a column, in order of appearance, and which each row
/// has.
struct LabelsOfRows {
  std::vector<std::string> labels;
  std::vector<std::size_t> codes;  // (rows asked for) index into labels
};
/// Of these rows of the table; it stops at the first row with one label more
/// than `most`, which is then the last of them.
LabelsOfRows LabelsOf(const CsvTable& table,
                      const CsvColumn& column,
                      const std::vector<std::ptrdiff_t>& rows,
                      std::size_t most);
inline constexpr auto kNoLimit = static_cast<std::size_t>(-1);

/// The rows 0, 1, ... of a table.
std::vector<std::ptrdiff_t> AllRows(std::size_t count);

/// Which of several files each of these rows (ascending) is of: index into
/// CsvTable::parts, which are not empty.
std::vector<std::ptrdiff_t> PartsOfRows(
    const CsvTable& table, const std::vector<std::ptrdiff_t>& rows);

/// The first of "name", "name_2", "name_3" that no column has.
std::string FreeName(const CsvTable& table, const std::string& name);

}  // namespace errmap::data
