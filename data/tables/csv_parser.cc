#include "data/tables/csv_parser.h"

#include <algorithm>
#include <optional>

#include "data/column_words.h"
#include "data/formula_text.h"
#include "data/tables/cells/csv_cells.h"
#include "data/tables/cells/loose_numbers.h"
#include "data/tables/cells/unit_cells.h"
#include "data/tables/column_names.h"
#include "data/tables/csv_dialect.h"
#include "data/tables/csv_layout.h"
#include "data/tables/odd_rows.h"
#include "data/tables/row_builder.h"
#include "data/tables/shapes/block_titles.h"
#include "data/tables/shapes/folded_positions.h"
#include "data/text.h"

namespace errmap::data {
namespace {

class Parser {
 public:
  Parser(std::string_view text,
         const std::string& name,
         char delimiter,
         OddRows odd)
      : text_(text),
        cells_(text, [this](std::size_t line) { return PlaceOfCell(line); }),
        odd_(odd) {
    table_.file = name;
    cells_.delimiter = delimiter;
  }

  CsvTable Parse() {
    CheckText();
    TakeSeparatorLine();
    SkipToTable();
    if (cells_.delimiter == CsvCells::kNoDelimiter) {
      dialect_ = FindDialect(cells_);
      cells_.delimiter = dialect_.delimiter;
    } else {
      dialect_ = {.delimiter = cells_.delimiter,
                  .decimal_comma = cells_.delimiter != ','};
    }
    layout_ = FindLayout(cells_, dialect_, text_);
    for (const std::string& remark : layout_.remarks) table_.Remark(remark);
    TakeNames();
    cells_.GoTo(layout_.data);
    TakeUnitsRow();
    cells_.LeaveEmptyEnd();
    cells_.width = layout_.width;
    LeaveOutCutLine();
    const CsvCells::Position begin = cells_.position();
    rows_.emplace(&table_);
    ReadRows();
    if (rows_->PartThousands()) {
      odd_rows_ = {};
      title_lines_.clear();
      blanks_.clear();
      loose_ = {};
      short_rows_.clear();
      cells_.GoTo(begin);
      ReadRows();
    }
    JudgeOddRows();
    rows_->DropTextsOfUndone();
    for (const std::string& line : odd_rows_.PassedOver()) table_.Remark(line);
    for (const std::string& line : loose_.Remarks()) table_.Remark(line);
    LeaveEmptyColumns();
    TakeUnitsOfCells(dialect_.decimal_comma, dialect_.decimal_points, &table_);
    TakeAngleCells(dialect_.decimal_comma, &table_);
    TakeTitles();
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

  // In the column that is being read, if there is one by that number.
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
              "NUL byte; this is not a text file: save it as CSV in UTF-8");
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

  void SkipToTable() {
    while (!cells_.at_end() &&
           (cells_.front() == '#' || cells_.AtBlankLine())) {
      if (cells_.line() == 1 && AtMark()) has_apostrophes_ = true;
      cells_.SkipLine();
    }
    if (cells_.at_end()) {
      throw InputError(File() +
                       ": no header, only comments or blank lines; it needs a "
                       "line of column names and rows of numbers below");
    }
  }

  void TakeNames() {
    std::vector<std::string> names;
    for (const std::string& text : layout_.names) {
      names.push_back(AsUtf8(TextOf(text)));
    }
    RefuseNumbers(names);
    NamedColumns named = NameColumns(names);
    table_.columns = std::move(named.columns);
    num_named_ = named.num_named;
    const std::size_t num = named.again.size();
    if (num == 0) return;
    constexpr std::size_t kMostShown = 5;
    named.again.resize(std::min(num, kMostShown));
    table_.Remark(
        "columns of one name: the later " +
        std::string(num == 1 ? "is" : "are") + " read as " +
        JoinWords(named.again, ", ") + (num > kMostShown ? ", ..." : "") +
        (IsSideBySide() ? "; put side-by-side tables below each other" : ""));
  }

  // A column without a name parts names that come again.
  bool IsSideBySide() const {
    const std::vector<std::string>& names = layout_.names;
    const auto gap = std::ranges::find(names, "");
    return gap != names.end() && gap + 1 != names.end() &&
           gap[1] == names.front();
  }

  // Numbers for names are positions, where FoldPositions takes them for such.
  void RefuseNumbers(const std::vector<std::string>& names) const {
    std::vector<double> numbers;
    std::size_t first = 0;
    for (std::size_t i = 0; i < names.size(); ++i) {
      NumberForm form;
      if (!ReadNumberForm(names[i], dialect_.decimal_comma, &form)) continue;
      if (numbers.empty()) first = i;
      numbers.push_back(form.value);
    }
    if (numbers.empty() || AreSpacedPositions(numbers)) return;
    const std::string shown = Printable(names[first], kShownName);
    ThrowAt(layout_.header_line,
            "no header: cell " + std::to_string(first + 1) + " is the number " +
                QuotedText(names[first]) + " where a column name should be; " +
                (numbers.size() < names.size()
                     ? "write a name in its place"
                     : "put a line of column names first") +
                " (of errors at a position: error_um@" + shown +
                "mm; of a run: Run " + shown + " [um])");
  }

  // The cells of a record from the cursor on, which stays.
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
    if (AreRules(units)) {
      cells_.SkipLine();
      if (cells_.at_end()) return;
      units = PeekRecord(0);
    }
    if (units.size() > table_.columns.size() ||
        !ReadUnitsOverNumbers(PeekRecord(1), dialect_.decimal_comma, &units)) {
      return;
    }
    for (std::size_t i = 0; i < units.size(); ++i) {
      CsvColumn& column = table_.columns[i];
      if (!units[i].empty() && column.has_name) {
        std::optional<std::string> name = NameWithUnit(column.name, units[i]);
        if (!name) {
          ThrowAt(cells_.line(),
                  "the unit " + QuotedText(units[i]) + " of column " +
                      QuotedName(column.name) +
                      " differs from that in its name; correct one of them");
        }
        column.name = std::move(*name);
      }
    }
    cells_.SkipLine();
  }

  // Lines above the table and among its rows.
  void TakeTitles() {
    std::vector<std::string>& titles = table_.titles;
    titles = std::move(layout_.titles);
    std::size_t nearest = titles.size();
    cells_.GoTo({text_.data(), 1});
    while (cells_.position().cursor < layout_.data.cursor) {
      if (cells_.front() == '#') {
        titles.insert(titles.begin(), TakeComment());
        const bool is_next =
            cells_.line() == layout_.header_line || layout_.header_line == 0;
        nearest = is_next || nearest == 0 ? 1 : nearest + 1;
      } else {
        cells_.SkipLine();
      }
    }
    if (nearest > 0) {
      title_lines_.insert(title_lines_.begin(),
                          {.row = 0, .text = titles[nearest - 1]});
    }
    PartByTitles(title_lines_, odd_rows_.num_names(), &table_);
    PartByBlankLines(blanks_, &table_);
    for (const TitleLine& line : title_lines_) {
      if (line.row == table_.num_rows) titles.push_back(line.text);
    }
  }

  // The words of a comment's line, which is passed over.
  std::string TakeComment() {
    std::string_view line = cells_.rest();
    line = line.substr(0, line.find_first_of("\n\r"));
    line.remove_prefix(std::min(line.find_first_not_of("# \t"), line.size()));
    cells_.SkipLine();
    return AsUtf8(Trimmed(line));
  }

  // Columns at the end without a name or a cell.
  void LeaveEmptyColumns() {
    auto& columns = table_.columns;
    while (columns.size() > 1 && !columns.back().has_name &&
           IsEmpty(columns.back())) {
      columns.pop_back();
    }
  }

  void LeaveOutCutLine() {
    const std::optional<CutLine> cut =
        FindCutLine(cells_.rest(), cells_.delimiter);
    if (!cut) return;
    cells_.LeaveOutEnd(cut->start);
    table_.Remark("the last line ends in the middle of a number (" +
                  QuotedText(cut->number) +
                  ") and is left out; complete it, or end it with a line end");
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
    ReserveRows();
    if (layout_.header_line != 0 && names_as_written_.empty()) {
      for (std::size_t i = 0; i < layout_.width; ++i) {
        names_as_written_.push_back(AsUtf8(TextOf(layout_.names[i])));
      }
    }
    blank_ = {};
    while (!cells_.at_end()) {
      if (cells_.front() == '#') {
        if (AtMarkedRow()) odd_rows_.AddMarked();
        title_lines_.push_back({.row = table_.num_rows, .text = TakeComment()});
      } else if (cells_.AtBlankLine()) {
        AddBlankLine(cells_.line());
        cells_.SkipLine();
      } else {
        if (blank_.count > 0 && table_.columns.size() == 1) {
          throw InputError(File() + ": line " + std::to_string(blank_.line) +
                           ": blank line inside the data; remove it, or start "
                           "it with #");
        }
        ReadRow(blank_.count > 0);
      }
    }
    in_data_ = false;
    if (table_.num_rows == 0 && odd_rows_.empty()) {
      throw InputError(File() + ": line " +
                       std::to_string(layout_.header_line) +
                       ": a header without data; put rows of numbers below it");
    }
  }

  // A comment of as many cells as a row, the last of them a number.
  bool AtMarkedRow() {
    const std::vector<std::string> cells = PeekRecord(0);
    NumberForm form;
    return layout_.width > 1 && cells.size() == layout_.width &&
           ReadNumberForm(cells.back(), dialect_.decimal_comma, &form);
  }

  void AddBlankLine(std::size_t line) {
    if (blank_.count++ > 0) return;
    blank_.line = line;
    blank_.row = table_.num_rows;
  }
  // Before a row that is one.
  void EndBlankLines() {
    if (blank_.count == 0) return;
    odd_rows_.AddBlank();
    blanks_.push_back(blank_);
    blank_ = {};
  }

  // Whether the last row, of so many cells, is a line of words: a remark, or
  // the name or date of what follows, with or without empty cells.
  bool IsTitle(std::size_t found) const {
    const std::string text =
        table_.CellText(table_.columns[0], table_.num_rows);
    return (found == 1 && IsRemark(table_)) ||
           ((HoldsDate(text) || IsRemark(table_)) && NamesSession(text) &&
            HoldsRemarkAlone(table_, column_));
  }

  // "Accuracy A", 12.4 and mostly empty cells, below the rows of a sheet.
  bool IsFigure(std::size_t found) const {
    return num_numbers_ > 0 && 2 * num_empty_ >= found &&
           !StatesTemperature(
               table_.CellText(table_.columns[0], table_.num_rows));
  }

  void ReadRow(bool after_blank) {
    const std::size_t line = cells_.line();
    column_ = 0;
    num_numbers_ = 0;
    num_empty_ = 0;
    is_beyond_ = false;
    last_named_is_empty_ = false;
    bool more = true;
    while (more && column_ < layout_.width) {
      more = ReadCell();
      ++column_;
    }
    std::size_t found = column_;
    for (; more; ++found) {
      cells_.Next();
      more = cells_.PassEnd();
    }
    if (layout_.width > 1 && num_numbers_ == 0 && IsEmptyRow(table_, column_)) {
      rows_->Undo(column_);
      AddBlankLine(line);
      return;
    }
    EndBlankLines();
    below_totals_ = AreTotals(table_) &&
                    (found == 2 || IsFigure(found) ||
                     ((after_blank || below_totals_) && found < layout_.width));
    if (below_totals_ ||
        (layout_.width > 2 && num_numbers_ == 0 && IsTitle(found))) {
      std::string words = table_.CellText(table_.columns[0], table_.num_rows);
      odd_rows_.AddWords(words);
      if (found == 2) {
        words += " " + table_.CellText(table_.columns[1], table_.num_rows);
      }
      title_lines_.push_back({.row = table_.num_rows, .text = words});
      rows_->Undo(column_);
    } else if (!HasItsCells(found)) {
      if (after_blank) ThrowAnotherTable(line, found);
      TakeOddRow(line, found);
    } else if (num_numbers_ == 0 && RepeatsNames(table_, names_as_written_)) {
      rows_->Undo(column_);
      odd_rows_.AddNames();
      below_names_ = true;
      return;
    } else if (below_names_ && num_numbers_ == 0 &&
               HasUnits(table_, layout_.width)) {
      rows_->Undo(column_);
    } else if (num_numbers_ == 0 && HasWordsForNumbers(table_, column_)) {
      ThrowAnotherTable(line, found);
    } else {
      if (found < layout_.width) short_rows_.push_back(line);
      for (; column_ < table_.columns.size(); ++column_) {
        rows_->AddText(column_, "");
      }
      rows_->End(line);
    }
    below_names_ = false;
  }

  // As many as most rows; or less by columns without a name, where it is sure
  // which are lacking.
  bool HasItsCells(std::size_t found) const {
    if (is_beyond_) return false;
    return found == layout_.width ||
           (found < layout_.width && found >= num_named_ &&
            layout_.header_line != 0 && !last_named_is_empty_);
  }

  [[noreturn]] void ThrowAnotherTable(std::size_t line,
                                      std::size_t found) const {
    throw InputError(
        File() + ": line " + std::to_string(line) +
        ": another table begins here (" + CountText(found, "field") +
        "); keep one table in a file, and put the others in separate files");
  }

  void TakeOddRow(std::size_t line, std::size_t found) {
    rows_->Undo(column_);
    odd_rows_.Add(line, found, table_.num_rows);
  }

  // ---- Rows of another length.

  // Rows that ended before columns without a name are whole where these are
  // empty throughout.
  void JudgeShortRows() {
    for (std::size_t i = num_named_; i < layout_.width; ++i) {
      const CsvColumn& column = table_.columns[i];
      if (short_rows_.empty() || IsEmpty(column)) continue;
      for (const std::size_t line : short_rows_) TakeOddRow(line, i);
      throw InputError(File() + ": " +
                       odd_rows_.RefusalText(
                           layout_, table_.num_rows, odd_, cells_.delimiter));
    }
  }

  static bool IsEmpty(const CsvColumn& column) {
    return column.is_text() && column.texts.size() == 1 &&
           column.texts.front().empty();
  }

  void JudgeOddRows() {
    JudgeShortRows();
    if (odd_rows_.empty()) return;
    if (odd_ != OddRows::kLeaveOut || table_.num_rows == 0)
      throw InputError(File() + ": " +
                       odd_rows_.RefusalText(
                           layout_, table_.num_rows, odd_, cells_.delimiter));
    table_.Remark(odd_rows_.LeftOutText(layout_));
  }

  // ---- Cells.

  // Reads a cell into its column; false where the row ends with it.
  bool ReadCell() {
    NumberForm form;
    std::string_view text = cells_.NextNumber(&form.value);
    bool is_number = !text.empty();
    if (is_number) {
      form.decimal_point = text.find('.') != std::string_view::npos;
    } else {
      text = cells_.Next();
      if (column_ + 1 == num_named_) last_named_is_empty_ = text.empty();
      is_number = ReadNumberForm(text, dialect_.decimal_comma, &form);
    }
    if (is_number) {
      rows_->AddNumber(column_, text, form);
    } else if (const Loose loose = ReadLooseNumber(text,
                                                   dialect_.decimal_comma,
                                                   dialect_.decimal_points,
                                                   &form);
               loose != Loose::kNone) {
      is_number = true;
      loose_.Add(loose, cells_.line());
      rows_->AddValue(column_, text, form);
    } else {
      rows_->AddText(column_, AsUtf8(TextOf(text)));
    }
    num_numbers_ += is_number ? 1 : 0;
    num_empty_ += text.empty() ? 1 : 0;
    if ((is_number || !text.empty()) && column_ >= layout_.num_names) {
      is_beyond_ = true;
    }
    return cells_.PassEnd();
  }

  static constexpr std::size_t kShownName = 20;

  std::string_view text_;
  CsvCells cells_;
  OddRows odd_;
  CsvDialect dialect_;
  CsvLayout layout_;
  bool has_apostrophes_ = false;  // kFormulaMark stands at the top
  bool in_data_ = false;
  std::size_t num_named_ = 0;  // columns down to the last with a name
  std::vector<std::string> names_as_written_;  // none without a header
  CsvTable table_;
  std::optional<RowBuilder> rows_;  // of it, once it has columns

  // Of the row that is being read.
  std::size_t column_ = 0;
  std::size_t num_numbers_ = 0;
  std::size_t num_empty_ = 0;
  bool is_beyond_ = false;  // it has something beyond the last name
  bool last_named_is_empty_ = false;
  bool below_names_ = false;
  bool below_totals_ = false;  // the row before held totals

  LooseNumbers loose_;
  BlankLines blank_;  // those right above
  std::vector<BlankLines> blanks_;
  std::vector<TitleLine> title_lines_;  // among the rows

  // Rows that are not in the table.
  OddRowList odd_rows_;
  std::vector<std::size_t> short_rows_;  // lines; they are in the table
};

}  // namespace

CsvTable ParseText(std::string_view text,
                   const std::string& name,
                   char delimiter,
                   OddRows odd) {
  return Parser(text, name, delimiter, odd).Parse();
}

}  // namespace errmap::data
