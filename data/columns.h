#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// A column of numbers; NaN is an empty cell.
CsvColumn NumberColumn(const std::string& name, std::vector<double> values);

/// A column whose row i has the text words[code of i].
CsvColumn WordColumn(const std::string& name,
                     const std::vector<std::ptrdiff_t>& codes,
                     std::vector<std::string> words);

/// Returns the cells of these rows of a column in this order; rows may repeat,
/// and -1 gives an empty cell.
CsvColumn TakeRows(const CsvColumn& column,
                   const std::vector<std::ptrdiff_t>& rows);

/// Returns these rows of a table, in this order. Each keeps its line of the
/// file.
CsvTable TakeRows(const CsvTable& table,
                  const std::vector<std::ptrdiff_t>& rows);

/// Appends the cells of `more` to those of `column`.
void AppendCells(const CsvColumn& more, CsvColumn* column);

/// Removes texts that no cell uses.
void DropUnusedTexts(CsvColumn* column);

/// The distinct texts of a column in order of appearance, and the index for
/// each row.
struct LabelsOfRows {
  std::vector<std::string> labels;
  std::vector<std::size_t> codes;  // (rows asked for) index into labels
};
/// Returns the labels of these rows of the table. Stops at the first row that
/// has label number `most` + 1, and keeps that label.
LabelsOfRows LabelsOf(const CsvTable& table,
                      const CsvColumn& column,
                      const std::vector<std::ptrdiff_t>& rows,
                      std::size_t most);
inline constexpr auto kNoLimit = static_cast<std::size_t>(-1);

/// The rows 0, 1, ... of a table.
std::vector<std::ptrdiff_t> AllRows(std::size_t count);

/// Returns the rows whose mark is true.
std::vector<std::ptrdiff_t> MarkedRows(const std::vector<bool>& marks);

/// Returns the values of a column in these rows.
std::vector<double> ValuesOf(const CsvColumn& column,
                             std::span<const std::ptrdiff_t> rows);

/// Returns the file of each of these rows (ascending), as an index into
/// CsvTable::parts, which must not be empty.
std::vector<std::ptrdiff_t> PartsOfRows(
    const CsvTable& table, const std::vector<std::ptrdiff_t>& rows);

/// Returns the starts of runs of equal codes.
std::vector<std::ptrdiff_t> RunStarts(const std::vector<std::ptrdiff_t>& codes);

/// Returns the first of "name", "name_2", "name_3" that no column has.
std::string FreeName(const CsvTable& table, const std::string& name);

}  // namespace errmap::data
