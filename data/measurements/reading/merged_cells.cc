#include "data/measurements/reading/merged_cells.h"

#include <cstddef>
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

bool NamesBlocks(const std::string& name) {
  return KeepsRecord(name) || IsCalled(name, Word::kDate) ||
         IsCalled(name, Word::kDirection) || IsCalled(name, Word::kPart);
}

// Rows of a column that are not empty.
std::vector<std::size_t> FilledRows(const CsvTable& table,
                                    const CsvColumn& column) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.num_rows; ++row) {
    const std::string* const text = column.TextAt(row);
    if (text == nullptr || !text->empty()) rows.push_back(row);
  }
  return rows;
}

// A thermometer that was read once in so many rows, as in each cycle.
bool IsReadSeldom(const std::string& name,
                  const std::vector<std::size_t>& rows) {
  constexpr std::size_t kFewestReadings = 3;
  if (!NamesTemperature(name) || rows.size() < kFewestReadings) return false;
  const std::size_t step = rows[1] - rows[0];
  if (step == 1) return false;  // and broken from some row on
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i] - rows[i - 1] != step) return false;
  }
  return true;
}

std::optional<CsvColumn> FilledDown(const CsvTable& table,
                                    const CsvColumn& given) {
  // Most columns are full, and quickly passed over.
  if (2 * given.exceptions.size() <= table.num_rows) return std::nullopt;
  const std::vector<std::size_t> rows = FilledRows(table, given);
  if (rows.empty() || rows.front() != 0 || 2 * rows.size() >= table.num_rows ||
      !(NamesBlocks(given.name) || IsReadSeldom(given.name, rows))) {
    return std::nullopt;
  }
  std::vector<Eigen::Index> from;
  auto next = rows.begin();
  for (std::size_t row = 0; row < table.num_rows; ++row) {
    const bool is_filled = next != rows.end() && *next == row;
    from.push_back(is_filled ? static_cast<Eigen::Index>(*next++)
                             : from.back());
  }
  return TakeRows(given, from);
}

}  // namespace

void FillMergedCells(CsvTable* table) {
  std::vector<std::string> names;
  for (CsvColumn& column : table->columns) {
    if (auto filled = FilledDown(*table, column)) {
      column = *std::move(filled);
      names.push_back(column.name);
    }
  }
  if (names.empty()) return;
  table->remarks.push_back("empty cells of " + ListOfNames(names) +
                           " are filled from the cell above");
}

}  // namespace errmap::data
