#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "data/csv.h"
#include "data/tables/cells/csv_cells.h"
#include "data/tables/cells/thousands.h"
#include "data/text_index.h"

namespace errmap::data {

/// Adds rows to the columns of a table cell by cell, and takes back what turns
/// out to be no row. A row becomes one by End.
class RowBuilder {
 public:
  /// `table`, with its columns and without rows, must outlive this.
  explicit RowBuilder(CsvTable* table)
      : table_(*table),
        texts_(table->columns.size()),
        shapes_(table->columns.size()) {}

  /// A number as it is written: plain, or with marks between its thousands
  /// where its column has them (PartThousands).
  void AddNumber(std::size_t column,
                 std::string_view text,
                 const NumberForm& form);
  /// A number that was read from a text of another form.
  void AddValue(std::size_t column, const NumberForm& form);
  void AddText(std::size_t column, std::string_view text);
  /// The row of these cells is whole and began on this line.
  void End(std::size_t line);
  /// Takes back the first `cells` of the row that was begun.
  void Undo(std::size_t cells);

  /// Whether the rows have to be read again, and takes them back: there are
  /// columns with marks between thousands.
  bool PartThousands(const std::function<void(const std::string&)>& say);
  /// Drops what only rows that were taken back had.
  void DropTextsOfUndone();

 private:
  CsvTable& table_;
  std::vector<TextIndex> texts_;     // (columns)
  std::vector<ColumnShape> shapes_;  // (columns)
  bool any_undone_ = false;
};

}  // namespace errmap::data
