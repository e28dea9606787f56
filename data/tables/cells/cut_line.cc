#include "data/tables/cells/cut_line.h"

#include <algorithm>

#include "data/tables/cells/csv_cells.h"

namespace errmap::data {
namespace {

// Lines looked at. Where all have as many decimals a few tell; where numbers
// are written without zeros at their ends it takes more.
constexpr std::size_t kMostLines = 100;
constexpr std::size_t kFewestOfOneForm = 4;
constexpr std::size_t kFewest = 20;

std::string_view LastLine(std::string_view rows) {
  const std::size_t end = rows.find_last_of("\n\r");
  return end == std::string_view::npos ? rows : rows.substr(end + 1);
}

std::string_view LastCell(std::string_view line, char delimiter) {
  const std::size_t at = line.find_last_of(delimiter);
  return TrimmedCell(at == std::string_view::npos ? line : line.substr(at + 1));
}

// Digits behind a number's point or comma.
std::optional<std::size_t> DecimalsOf(std::string_view cell) {
  NumberForm form;
  if (!ReadNumberForm(cell, true, &form) ||
      cell.find_first_of("eE") != std::string_view::npos) {
    return std::nullopt;
  }
  const std::size_t mark = cell.find_first_of(".,");
  return mark == std::string_view::npos ? 0 : cell.size() - mark - 1;
}

}  // namespace

std::optional<CutLine> FindCutLine(std::string_view rows, char delimiter) {
  if (rows.empty() || IsLineEnd(rows.back())) return std::nullopt;
  const std::string_view last = LastLine(rows);
  const std::string_view number = LastCell(last, delimiter);
  const std::optional<std::size_t> left = DecimalsOf(number);
  if (!left) return std::nullopt;
  std::size_t fewest = std::string::npos;
  std::size_t most = 0;
  std::size_t lines = 0;
  rows.remove_suffix(last.size());
  for (; lines < kMostLines && !rows.empty(); ++lines) {
    rows.remove_suffix(1);
    if (rows.ends_with('\r')) rows.remove_suffix(1);
    const std::string_view line = LastLine(rows);
    const std::optional<std::size_t> decimals =
        DecimalsOf(LastCell(line, delimiter));
    if (!decimals) break;
    fewest = std::min(fewest, *decimals);
    most = std::max(most, *decimals);
    rows.remove_suffix(line.size());
  }
  if (lines < (fewest == most ? kFewestOfOneForm : kFewest) ||
      *left >= fewest) {
    return std::nullopt;
  }
  return CutLine{.start = last.data(), .number = std::string(number)};
}

}  // namespace errmap::data
