#include "data/tables/shapes/input_rows.h"

#include <algorithm>

#include "data/column_header.h"
#include "data/column_words.h"

namespace errmap::data {
namespace {

// "T1" is a tool in a column of words, and a thermometer among numbers.
bool NamesInput(const std::string& text, bool among_words) {
  if (StatesTemperature(text)) return true;
  if (among_words) return false;
  const Header header = ReadHeader(text);
  return NamesTemperature(text) || (header.source == UnitSource::kStated &&
                                    !IsLengthOrAngle(header.unit));
}

// The first of `rows` behind a row, or the last before it; else the only side.
std::ptrdiff_t Nearest(const std::vector<std::ptrdiff_t>& rows,
                       std::ptrdiff_t row,
                       bool before) {
  auto found = std::ranges::lower_bound(rows, row);
  if (before ? found != rows.begin() : found == rows.end()) --found;
  return *found;
}

}  // namespace

InputRows FindInputRows(const CsvTable& table,
                        const std::vector<std::size_t>& columns) {
  std::map<std::string, std::vector<std::ptrdiff_t>> named;
  std::vector<bool> is_input(table.num_rows, false);
  for (const std::size_t i : columns) {
    const CsvColumn& column = table.columns[i];
    for (const auto& [row, text] : column.exceptions) {
      const std::string& name = column.texts[text];
      if (is_input[row] || !NamesInput(name, column.is_text())) continue;
      is_input[row] = true;
      named[name].push_back(static_cast<std::ptrdiff_t>(row));
    }
  }
  InputRows found;
  for (std::size_t row = 0; row < is_input.size(); ++row) {
    if (!is_input[row]) found.errors.push_back(std::ptrdiff_t(row));
  }
  if (found.errors.empty()) return found;
  for (auto& [name, rows] : named) {
    std::ranges::sort(rows);
    for (const std::ptrdiff_t row : found.errors) {
      found.inputs[name].push_back(Nearest(rows, row, is_input[0]));
    }
  }
  return found;
}

}  // namespace errmap::data
