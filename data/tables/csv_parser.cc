// ParseCsv of data/csv.h: one pass over the text, cell by cell.

#include <algorithm>
#include <limits>
#include <optional>
#include <unordered_map>

#include "data/csv.h"
#include "data/files/atomic_file.h"
#include "data/files/sheet_path.h"
#include "data/formula_text.h"
#include "data/tables/csv_cells.h"
#include "data/tables/gzip.h"
#include "data/tables/spreadsheet.h"
#include "data/tables/text_encoding.h"
#include "data/text.h"
#include "data/text_index.h"
#include "data/units.h"

namespace errmap::data {
namespace {

// Whether a cell below a name is a unit or nothing: "mm", "[um]", "-"; a unit
// comes back without its brackets, nothing as "".
bool ReadUnitCell(std::string* cell) {
  std::string_view text = *cell;
  if (text.size() > 1 && ((text.front() == '[' && text.back() == ']') ||
                          (text.front() == '(' && text.back() == ')'))) {
    text = Trimmed(text.substr(1, text.size() - 2));
  }
  if (text.empty() || text == "-") {
    cell->clear();
    return true;
  }
  double number = 0.0;
  if (ParseNumber(text, &number)) return false;
  const bool is_unit =
      ReadHeader("x [" + std::string(text) + "]").source == UnitSource::kStated;
  *cell = std::string(text);
  return is_unit;
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& name, char delimiter)
      : cells_(text, [this](std::size_t line) { return PlaceOfCell(line); }) {
    table_.file = name;
    cells_.delimiter = delimiter;
  }

  CsvTable Parse() {
    CheckText();
    TakeSeparatorLine();
    SkipToHeader();
    char& delimiter = cells_.delimiter;
    if (delimiter == CsvCells::kNoDelimiter) {
      delimiter = FindDelimiter(cells_.rest());
    }
    decimal_comma_ = delimiter != ',' && delimiter != CsvCells::kNoDelimiter;
    ReadHeader();
    TakeUnitsRow();
    cells_.LeaveEmptyEnd();
    ReserveRows();
    ReadRows();
    LeaveEmptyColumns();
    return std::move(table_);
  }

 private:
  // ---- Places and errors.

  std::string File() const { return PrintablePath(table_.file); }

  std::string Place(std::size_t line) const {
    return File() + ": line " + std::to_string(line) +
           (in_data_ ? " (data row " + std::to_string(table_.num_rows) + ")"
                     : "");
  }

  // In the column that is being read, where there is one by that number.
  std::string PlaceOfCell(std::size_t line) const {
    const bool is_known = in_data_ && column_ < table_.columns.size();
    return Place(line) +
           (is_known ? ", column " + QuotedName(table_.columns[column_].name)
                     : "");
  }

  [[noreturn]] void ThrowAt(std::size_t line, const std::string& what) const {
    throw InputError(Place(line) + ": " + what);
  }

  bool AtMark() const {
    const std::string_view rest = cells_.rest();
    return rest.starts_with(kFormulaMark) &&
           rest.size() > kFormulaMark.size() &&
           IsLineEnd(rest[kFormulaMark.size()]);
  }

  std::string_view TextOf(std::string_view field) const {
    return has_apostrophes_ ? WithoutApostrophe(field) : field;
  }

  // ---- Before the data.

  void CheckText() {
    const std::string_view text = cells_.rest();
    if (text.starts_with("\xEF\xBB\xBF")) cells_.SkipBytes(3);
    const std::size_t nul = text.find('\0');
    if (nul != std::string_view::npos) {
      ThrowAt(1 + CountLineEnds(text.substr(0, nul)),
              "NUL byte; this is no text file: save it as CSV in UTF-8");
    }
    if (cells_.at_end()) {
      throw InputError(File() +
                       ": the file is empty; it needs a line of column names "
                       "and rows of numbers below");
    }
  }

  // "sep=;", as spreadsheets write and read it above the header.
  void TakeSeparatorLine() {
    std::string_view line = cells_.rest();
    line = line.substr(0, line.find_first_of("\n\r"));
    if (line.size() > 2 && line.front() == '"' && line.back() == '"') {
      line = line.substr(1, line.size() - 2);
    }
    constexpr std::string_view kSeparator = "sep=";
    if (line.size() != kSeparator.size() + 1 ||
        !StartsWithIgnoringCase(line, kSeparator)) {
      return;
    }
    cells_.delimiter = line.back();
    cells_.SkipLine();
  }

  void SkipToHeader() {
    while (!cells_.at_end() &&
           (cells_.front() == '#' || cells_.AtBlankLine())) {
      if (cells_.front() == '#') comment_before_header_ = cells_.line();
      if (cells_.line() == 1 && AtMark()) has_apostrophes_ = true;
      cells_.SkipLine();
    }
    if (cells_.at_end()) {
      throw InputError(File() +
                       ": no header, only comments or blank lines; it needs a "
                       "line of column names and rows of numbers below");
    }
  }

  void ReadHeader() {
    const std::size_t line = cells_.line();
    std::unordered_map<std::string, std::size_t> numbers;  // by name, 1-based
    for (bool more = true; more;) {
      const std::size_t number = table_.columns.size() + 1;
      std::string name = AsUtf8(TextOf(cells_.Next()));
      more = cells_.PassEnd();
      if (NumberForm form{}; ReadNumber(name, &form)) {
        ThrowAt(line,
                "no header: cell " + std::to_string(number) +
                    " is the number " + QuotedText(name) +
                    " where a column name should be; put a line of column "
                    "names first" +
                    (comment_before_header_ == 0
                         ? ""
                         : " (line " + std::to_string(comment_before_header_) +
                               " starts with # and so is a comment)"));
      }
      const bool has_name = !name.empty();
      if (!has_name) name = "column_" + std::to_string(number);
      const auto [other, is_new] = numbers.emplace(name, number);
      if (!is_new) {
        ThrowAt(line,
                "columns " + std::to_string(other->second) + " and " +
                    std::to_string(number) + " are both named " +
                    QuotedName(name) + "; rename one of them");
      }
      table_.columns.emplace_back();
      table_.columns.back().name = std::move(name);
      table_.columns.back().has_name = has_name;
    }
    texts_.resize(table_.columns.size());
    header_line_ = line;
  }

  // What the unit of a column of this name and unit makes of it; throws where
  // the two do not agree.
  std::string WithUnit(const std::string& name, std::string_view unit) const {
    const Header header = data::ReadHeader(name);
    if (header.source == UnitSource::kStated) {
      if (header.unit ==
          data::ReadHeader("x [" + std::string(unit) + "]").unit) {
        return name;
      }
      ThrowAt(cells_.line(),
              "the unit " + QuotedText(unit) + " of column " +
                  QuotedName(name) +
                  " is another than in its name; correct "
                  "one of them");
    }
    return name + " [" + std::string(unit) + "]";
  }

  // The cells of the record at the cursor, which stays.
  std::vector<std::string> PeekRecord(std::size_t record) {
    const auto saved = cells_.position();
    std::vector<std::string> cells;
    try {
      for (std::size_t i = 0; i <= record; ++i) {
        cells.clear();
        if (cells_.at_end()) break;
        do {
          cells.push_back(AsUtf8(TextOf(cells_.Next())));
        } while (cells_.PassEnd());
      }
    } catch (const InputError&) {
      cells.clear();  // to be told where the row is read
    }
    cells_.GoTo(saved);
    return cells;
  }

  // Units below the names, "mm, degC, [um]", each over a number or nothing:
  // they become part of the names.
  void TakeUnitsRow() {
    if (cells_.at_end() || cells_.front() == '#' || cells_.AtBlankLine())
      return;
    std::vector<std::string> units = PeekRecord(0);
    if (units.size() > table_.columns.size()) return;
    bool any = false;
    for (std::string& text : units) {
      if (!ReadUnitCell(&text)) return;
      any = any || !text.empty();
    }
    if (!any) return;
    const std::vector<std::string> below = PeekRecord(1);
    for (std::size_t i = 0; i < units.size(); ++i) {
      if (units[i].empty()) continue;
      NumberForm form{};
      if (i >= below.size() || !ReadNumber(below[i], &form)) return;
    }
    for (std::size_t i = 0; i < units.size(); ++i) {
      CsvColumn& column = table_.columns[i];
      if (!units[i].empty() && column.has_name) {
        column.name = WithUnit(column.name, units[i]);
      }
    }
    cells_.SkipLine();
  }

  // Columns at the end without a name or a cell.
  void LeaveEmptyColumns() {
    auto& columns = table_.columns;
    while (columns.size() > 1 && !columns.back().has_name &&
           columns.back().is_text() && columns.back().texts.size() == 1 &&
           columns.back().texts.front().empty()) {
      columns.pop_back();
    }
  }

  // No more rows than lines, and none shorter than its delimiters. Memory that
  // turns out not to be needed (quoted line breaks, comments) is never touched.
  void ReserveRows() {
    const std::string_view rest = cells_.rest();
    std::ptrdiff_t lines = std::ranges::count(rest, '\n');
    if (lines == 0) lines = std::ranges::count(rest, '\r');
    const std::size_t rows = std::min(static_cast<std::size_t>(lines),
                                      rest.size() / table_.columns.size()) +
                             1;
    for (CsvColumn& column : table_.columns) column.values.reserve(rows);
  }

  // ---- The data.

  void ReadRows() {
    in_data_ = true;
    std::size_t blank_line = 0;
    while (!cells_.at_end()) {
      if (cells_.front() == '#') {
        cells_.SkipLine();
      } else if (cells_.AtBlankLine()) {
        if (blank_line == 0) blank_line = cells_.line();
        cells_.SkipLine();
      } else if (blank_line != 0) {
        throw InputError(File() + ": line " + std::to_string(blank_line) +
                         ": blank line inside the data; remove it, or start "
                         "it with #");
      } else {
        ReadRow();
      }
    }
    if (table_.num_rows == 0) {
      throw InputError(File() + ": line " + std::to_string(header_line_) +
                       ": a header without data; put rows of numbers below it");
    }
  }

  void ReadRow() {
    const std::size_t line = cells_.line();
    auto& runs = table_.line_runs;
    if (runs.empty() ||
        runs.back().second + (table_.num_rows - runs.back().first) != line) {
      runs.emplace_back(table_.num_rows, line);
    }
    column_ = 0;
    while (column_ < table_.columns.size() && ReadCell()) ++column_;
    if (column_ + 1 != table_.columns.size() && !EndsEmpty()) ThrowRagged(line);
    ++table_.num_rows;
  }

  // Whether a row with more or less cells than the header has nothing beyond
  // the last name; columns that it left out become empty.
  bool EndsEmpty() {
    if (column_ == table_.columns.size()) return cells_.PassEmptyRest();
    for (std::size_t i = column_ + 1; i < table_.columns.size(); ++i) {
      if (table_.columns[i].has_name) return false;
    }
    while (++column_ < table_.columns.size()) {
      StoreText("", &table_.columns[column_]);
    }
    return true;
  }

  [[noreturn]] void ThrowRagged(std::size_t line) {
    std::size_t found = column_ + 1;
    if (column_ == table_.columns.size()) {
      for (cells_.Next(); cells_.PassEnd(); cells_.Next()) ++found;
    }
    std::string what =
        std::to_string(found) + (found == 1 ? " field" : " fields") +
        " where the header has " + std::to_string(table_.columns.size()) +
        "; complete the row or remove it";
    if (table_.num_rows == 0 && table_.columns.size() == 1) {
      what +=
          ", or, where the names stand further down, start the lines above "
          "them with #";
    } else if (cells_.delimiter == ',' && found > table_.columns.size()) {
      what +=
          " (if these are decimal commas, write decimal points or separate "
          "the columns with ; or tab)";
    }
    ThrowAt(line, what);
  }

  // Reads a cell into its column; false where the row ends with it.
  bool ReadCell() {
    CsvColumn& column = table_.columns[column_];
    double value = 0.0;
    if (const auto number = cells_.NextNumber(&value); !number.empty()) {
      StoreNumber({value, false, HasPoint(number)}, &column);
      return cells_.PassEnd();
    }
    const std::string_view field = cells_.Next();
    if (NumberForm form{}; ReadNumber(field, &form)) {
      StoreNumber(form, &column);
    } else {
      StoreText(field, &column);
    }
    return cells_.PassEnd();
  }

  struct NumberForm {
    double value;
    bool decimal_comma;
    bool decimal_point;
  };

  static bool HasPoint(std::string_view text) {
    return text.find('.') != std::string_view::npos;
  }

  bool ReadNumber(std::string_view field, NumberForm* form) {
    form->decimal_point = HasPoint(field);
    form->decimal_comma = false;
    if (decimal_comma_ && !form->decimal_point) {
      const std::size_t comma = field.find(',');
      if (comma != std::string_view::npos) {
        // A second comma stays and is no part of a number.
        point_form_ = field;
        point_form_[comma] = '.';
        form->decimal_comma = true;
        return ParseNumber(point_form_, &form->value);
      }
    }
    return ParseNumber(field, &form->value);
  }

  void StoreNumber(const NumberForm& form, CsvColumn* column) const {
    const auto row = static_cast<std::ptrdiff_t>(table_.num_rows);
    if (form.decimal_comma && column->first_decimal_comma < 0) {
      column->first_decimal_comma = row;
    }
    if (form.decimal_point && column->first_decimal_point < 0) {
      column->first_decimal_point = row;
    }
    column->values.push_back(form.value);
  }

  void StoreText(std::string_view field, CsvColumn* column) {
    const std::uint32_t index =
        texts_[column_].IndexOf(AsUtf8(TextOf(field)), &column->texts);
    column->exceptions.emplace_back(table_.num_rows, index);
    column->values.push_back(std::numeric_limits<double>::quiet_NaN());
  }

  CsvCells cells_;
  bool decimal_comma_ = false;
  bool has_apostrophes_ = false;           // kFormulaMark stands at the top
  std::size_t comment_before_header_ = 0;  // line of the last one, or 0
  std::size_t header_line_ = 0;
  bool in_data_ = false;
  std::size_t column_ = 0;        // being read, within the data
  std::vector<TextIndex> texts_;  // (columns)
  std::string point_form_;        // scratch: cell with its comma made a point
  CsvTable table_;
};

}  // namespace

CsvTable ParseCsv(std::string_view text, const std::string& name) {
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
  if (sheet) return Parser(*sheet, name, '\t').Parse();
  const std::string converted = TextOfFile(text, name);
  return Parser(
             converted.empty() ? text : converted, name, CsvCells::kNoDelimiter)
      .Parse();
}

}  // namespace errmap::data
