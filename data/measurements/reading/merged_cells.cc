#include "data/measurements/reading/merged_cells.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/column_words.h"
#include "data/columns.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_roles.h"

namespace errmap::data {

namespace {

std::optional<CsvColumn> FilledDown(const CsvTable& table,
                                    const CsvColumn& given) {
  const std::string& name = given.name;
  const bool names_blocks = KeepsRecord(name) || IsCalled(name, Word::kDate) ||
                            IsCalled(name, Word::kDirection) ||
                            IsCalled(name, Word::kPart);
  if (!names_blocks) return std::nullopt;
  const auto is_empty = [&](std::size_t row) {
    const std::string* const text = given.TextAt(row);
    return text != nullptr && text->empty();
  };
  std::size_t empty = 0;
  for (const auto& [row, text] : given.exceptions) {
    empty += given.texts[text].empty() ? 1 : 0;
  }
  if (2 * empty <= table.num_rows || is_empty(0)) return std::nullopt;
  std::vector<Eigen::Index> from;
  for (std::size_t row = 0; row < table.num_rows; ++row) {
    from.push_back(is_empty(row) ? from.back()
                                 : static_cast<Eigen::Index>(row));
  }
  return TakeRows(given, from);
}

}  // namespace

std::vector<FilledColumn> FindMergedCells(const CsvTable& table) {
  std::vector<FilledColumn> found;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (auto filled = FilledDown(table, table.columns[i])) {
      found.push_back({i, *std::move(filled)});
    }
  }
  return found;
}

void FillMergedCells(const std::vector<FilledColumn>& columns,
                     CsvTable* table) {
  std::vector<std::string> names;
  for (const FilledColumn& column : columns) {
    table->columns[column.column] = column.filled;
    names.push_back(column.filled.name);
  }
  if (names.empty()) return;
  table->remarks.push_back("empty cells of " + ListOfNames(names) +
                           " are filled from above, as merged cells");
}

}  // namespace errmap::data
