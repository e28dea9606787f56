#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data/csv.h"
#include "data/tables/cells/csv_cells.h"
#include "data/tables/cells/thousands.h"
#include "data/text_index.h"

namespace errmap::data {

/// Adds rows to the columns of a table cell by cell, and removes cells that
/// turn out not to form a row. End completes a row.
class RowBuilder {
 public:
  /// `table`, with its columns and without rows, must outlive this.
  explicit RowBuilder(CsvTable* table)
      : table_(*table),
        texts_(table->columns.size()),
        shapes_(table->columns.size()) {}

  /// Adds a number as written: plain, or with thousands separators if its
  /// column has them (PartThousands).
  void AddNumber(std::size_t column,
                 std::string_view text,
                 const NumberForm& form);
  /// Adds a number that was read from text of another form.
  void AddValue(std::size_t column,
                std::string_view text,
                const NumberForm& form);
  void AddText(std::size_t column, std::string_view text);
  /// Completes the row of these cells, which began on this line.
  void End(std::size_t line);
  /// Removes the first `cells` cells of the unfinished row.
  void Undo(std::size_t cells);

  /// Returns true, and removes all rows, if they must be read again because
  /// columns have thousands separators.
  bool PartThousands();
  /// Removes texts that only removed rows used.
  void DropTextsOfUndone();

 private:
  CsvTable& table_;
  std::vector<TextIndex> texts_;     // (columns)
  std::vector<ColumnShape> shapes_;  // (columns)
  bool any_undone_ = false;
};

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
