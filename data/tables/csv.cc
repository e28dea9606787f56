#include "data/csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>

#include "data/files/atomic_file.h"
#include "data/files/sheet_path.h"
#include "data/files_in_memory.h"
#include "data/formula_text.h"
#include "data/sha256.h"
#include "data/tables/cells/csv_cells.h"
#include "data/tables/csv_parser.h"
#include "data/tables/shapes/folded_positions.h"
#include "data/tables/shapes/long_table.h"
#include "data/tables/shapes/notes.h"
#include "data/tables/text/gzip.h"
#include "data/tables/text/rewritten_text.h"
#include "data/tables/text/spreadsheet.h"
#include "data/tables/text/text_encoding.h"
#include "data/text.h"

namespace errmap::data {

const std::string* CsvColumn::TextAt(std::size_t row) const {
  const auto found = std::ranges::lower_bound(
      exceptions, row, {}, [](const auto& cell) { return cell.first; });
  return found != exceptions.end() && found->first == row
             ? &texts[found->second]
             : nullptr;
}

std::ptrdiff_t CsvTable::Find(std::string_view name) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const CsvColumn& c) {
        return c.name == name;
      });
  return found == columns.end() ? -1 : found - columns.begin();
}

std::size_t CsvTable::LineOfRow(std::size_t row) const {
  const auto next = std::upper_bound(
      line_runs.begin(),
      line_runs.end(),
      row,
      [](std::size_t value, const auto& run) { return value < run.first; });
  // A table made in memory has no lines.
  if (next == line_runs.begin()) return 0;
  const auto& [first_row, first_line] = *std::prev(next);
  return first_line + (row - first_row);
}

std::string CsvTable::Where(std::size_t row, std::string_view column) const {
  const auto next = std::ranges::upper_bound(
      parts, row, {}, &std::pair<std::size_t, std::string>::first);
  const bool is_one = next == parts.begin();
  const std::size_t first = is_one ? 0 : std::prev(next)->first;
  const std::string at = std::to_string(row - first);
  return PrintablePath(is_one ? file : std::prev(next)->second) + ": " +
         (line_runs.empty() ? "row " + at
                            : "line " + std::to_string(LineOfRow(row)) +
                                  " (data row " + at + ")") +
         ", column " + QuotedName(column);
}

std::string CsvTable::CellText(const CsvColumn& column, std::size_t row) const {
  const std::string* const text = column.TextAt(row);
  return text != nullptr ? *text : CsvNumber(column.values[row]);
}

void CsvTable::Remark(const std::string& what) {
  remarks.push_back(PrintablePath(file) + ": " + what);
}

CsvTable ReadCsv(const std::string& path, OddRows odd) {
  if (const CsvTable* const table = FilesInMemory::FindTable(path)) {
    return *table;
  }
  return ParseCsv(ReadFile(path), path, odd);
}

CsvTable ReadCsv(const std::string& path, std::string* sha256, OddRows odd) {
  if (FilesInMemory::FindTable(path) != nullptr) {
    *sha256 = Sha256OfFile(path);
    return ReadCsv(path);
  }
  const std::string text = ReadFile(path);
  *sha256 = Sha256(text);
  return ParseCsv(text, path, odd);
}

std::string CsvField(std::string_view text) {
  const std::string safe =
      (NeedsApostrophe(text) ? "'" : "") + std::string(text);
  text = safe;
  const bool needs_quotes =
      text.find_first_of(",;\"\t\r\n") != std::string_view::npos ||
      text.starts_with('#') || Trimmed(text).size() != text.size();
  if (!needs_quotes) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string CsvNumber(double value) {
  if (std::isnan(value)) return "";
  // The longest is of the form -2.2250738585072014e-308.
  std::array<char, 32> buffer{};
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end};
}

CsvTable ParseCsv(std::string_view text, const std::string& name, OddRows odd) {
  std::string unpacked;
  std::optional<std::string> sheet;
  try {
    if (IsGzip(text)) {
      unpacked = Gunzip(
          text, std::min(kMostTextOfPrograms, MostUnpacked(text.size())));
      if (IsGzip(unpacked)) unpacked.clear();
      text = unpacked;
    }
    sheet = SheetText(text, SplitSheetPath(name).sheet);
  } catch (const InputError& error) {
    throw InputError(PrintablePath(name) + ": " + error.what());
  }
  const EncodedText converted =
      sheet ? EncodedText{.text = *sheet} : TextOfFile(text, name);
  if (!converted.text.empty()) text = converted.text;
  const std::optional<std::string> rewritten = RewrittenText(text);
  if (rewritten) text = *rewritten;
  const char delimiter = sheet ? '\t' : CsvCells::kNoDelimiter;
  CsvTable table = ParseText(text, name, delimiter, odd);
  TurnTable(&table);
  FoldPositions(&table);
  SpreadReadings(&table);
  TakeUnitsOfNotes(&table);
  if (!converted.encoding.empty()) {
    table.remarks.insert(table.remarks.begin(),
                         PrintablePath(name) + ": the text is read as " +
                             converted.encoding +
                             ", by the words of its first lines");
  }
  return table;
}

}  // namespace errmap::data
