#include "data/tables/last_row.h"

#include <utility>
#include <vector>

#include "data/tables/cells/missing_cells.h"
#include "data/tables/cells/unit_cells.h"
#include "data/text.h"

namespace errmap::data {
namespace {

const std::string& TextIn(const CsvTable& table, std::size_t index) {
  const CsvColumn& column = table.columns[index];
  return column.texts[column.exceptions.back().second];
}

// Whether most cells above the last row are numbers.
bool HoldsNumbers(const CsvTable& table, const CsvColumn& column) {
  return 2 * (column.exceptions.size() - 1) < table.num_rows;
}

}  // namespace

bool IsRemark(const CsvTable& table) {
  const std::string& text = TextIn(table, 0);
  return text.size() > 2 && !HasDigit(text.substr(0, 1)) &&
         !IsMissingNumber(text) && text.find(' ') != text.npos;
}

bool IsEmptyRow(const CsvTable& table, std::size_t cells) {
  for (std::size_t i = 0; i < cells; ++i) {
    if (!TextIn(table, i).empty()) return false;
  }
  return true;
}

bool HoldsRemarkAlone(const CsvTable& table, std::size_t cells) {
  const CsvColumn& first = table.columns[0];
  if (table.num_rows > 0 && !HoldsNumbers(table, first)) return false;
  for (std::size_t i = 1; i < cells; ++i) {
    if (!TextIn(table, i).empty()) return false;
  }
  return true;
}

bool AreTotals(const CsvTable& table) {
  constexpr std::size_t kFewestOfRow = 4;
  const CsvColumn& first = table.columns[0];
  if (table.columns.size() < kFewestOfRow || table.num_rows == 0 ||
      first.exceptions.empty() ||
      first.exceptions.back().first != table.num_rows ||
      !HoldsNumbers(table, first)) {
    return false;
  }
  const std::string& text = TextIn(table, 0);
  return !IsMissingNumber(text) && text.find_first_of("0123456789+-.") != 0;
}

bool RepeatsNames(const CsvTable& table, std::span<const std::string> names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (TextIn(table, i) != names[i]) return false;
  }
  return table.num_rows > 0 && !names.empty();
}

bool HasUnits(const CsvTable& table, std::size_t width) {
  std::vector<std::string> cells;
  for (std::size_t i = 0; i < width; ++i) cells.push_back(TextIn(table, i));
  return AreUnitCells(std::move(cells));
}

bool HasWordsForNumbers(const CsvTable& table, std::size_t cells) {
  std::size_t num_numeric = 0;
  std::size_t num_words = 0;
  for (std::size_t i = 0; i < cells; ++i) {
    if (!HoldsNumbers(table, table.columns[i])) continue;
    ++num_numeric;
    num_words += IsMissingNumber(TextIn(table, i)) ? 0 : 1;
  }
  return num_numeric > 1 && 2 * num_words >= num_numeric;
}

}  // namespace errmap::data
