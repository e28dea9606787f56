// ParseCsv of data/csv.h: one pass over the text, cell by cell.

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <system_error>
#include <tuple>
#include <unordered_map>

#include "data/atomic_file.h"
#include "data/csv.h"
#include "data/formula_text.h"
#include "data/gzip.h"
#include "data/text.h"
#include "data/text_encoding.h"
#include "data/units.h"

namespace errmap::data {
namespace {

// No cell can hold a NUL (Parser refuses them), so none ends at this one.
constexpr char kNoDelimiter = '\0';

// Where all else is equal the rarer character wins: commas and semicolons
// occur in names.
constexpr std::array<char, 4> kDelimiters = {'\t', ';', '|', ','};
using DelimiterCounts = std::array<std::size_t, kDelimiters.size()>;

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

bool IsLineEnd(char c) { return c == '\n' || c == '\r'; }

// LF, CRLF and a lone CR (old Macintosh) each end one line.
std::size_t CountLineEnds(const char* begin, const char* end) {
  std::size_t count = 0;
  for (const char* p = begin; p != end; ++p) {
    const bool before_lf = *p == '\r' && p + 1 != end && p[1] == '\n';
    if (IsLineEnd(*p) && !before_lf) ++count;
  }
  return count;
}

// Each distinct text of a column once: an open-addressing table of indices
// into CsvColumn::texts, without a second copy of them.
class TextIndex {
 public:
  std::uint32_t IndexOf(std::string_view text,
                        std::vector<std::string>* texts) {
    if (2 * (texts->size() + 1) > slots_.size()) Grow(*texts);
    std::uint32_t& slot = slots_[SlotOf(text, *texts)];
    if (slot == 0) {
      texts->emplace_back(text);
      slot = static_cast<std::uint32_t>(texts->size());
    }
    return slot - 1;
  }

 private:
  std::size_t SlotOf(std::string_view text,
                     const std::vector<std::string>& texts) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = std::hash<std::string_view>{}(text)&mask;
    while (slots_[i] != 0 && texts[slots_[i] - 1] != text) i = (i + 1) & mask;
    return i;
  }

  void Grow(const std::vector<std::string>& texts) {
    constexpr std::size_t kLeast = 16;
    slots_.assign(std::max(kLeast, 2 * slots_.size()), 0);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      slots_[SlotOf(texts[i], texts)] = static_cast<std::uint32_t>(i + 1);
    }
  }

  std::vector<std::uint32_t> slots_;  // 1 + index, 0 where free; a power of two
};

class Parser {
 public:
  Parser(std::string_view text, const std::string& name)
      : cursor_(text.data()), end_(text.data() + text.size()) {
    table_.file = name;
  }

  CsvTable Parse() {
    CheckText();
    TakeSeparatorLine();
    SkipToHeader();
    if (delimiter_ == kNoDelimiter) ChooseDelimiter();
    decimal_comma_ = delimiter_ != ',' && delimiter_ != kNoDelimiter;
    ReadHeader();
    TakeUnitsRow();
    LeaveEmptyEnd();
    ReserveRows();
    ReadRows();
    LeaveEmptyColumns();
    return std::move(table_);
  }

 private:
  // ---- Places and errors.

  std::string File() const { return PrintablePath(table_.file); }

  [[noreturn]] void ThrowAt(std::size_t line, const std::string& what) const {
    std::string place = File() + ": line " + std::to_string(line);
    if (in_data_) {
      place += " (data row " + std::to_string(table_.num_rows) + ")";
    }
    throw InputError(place + ": " + what);
  }

  // In the column that is being read, where there is one by that number.
  [[noreturn]] void ThrowInCell(std::size_t line,
                                const std::string& what) const {
    if (in_data_ && column_ < table_.columns.size()) {
      throw InputError(File() + ": line " + std::to_string(line) +
                       " (data row " + std::to_string(table_.num_rows) +
                       "), column " + QuotedName(table_.columns[column_].name) +
                       ": " + what);
    }
    ThrowAt(line, what);
  }

  // ---- Characters.

  bool IsBlank(char c) const {
    return c == ' ' || (c == '\t' && delimiter_ != '\t');
  }

  // Cells stand apart by any number of blanks.
  bool by_blanks() const { return delimiter_ == ' '; }

  const char* SkipBlanks(const char* p) const {
    while (p != end_ && IsBlank(*p)) ++p;
    return p;
  }

  bool EndsCell(const char* p) const {
    return p == end_ || *p == delimiter_ || IsLineEnd(*p) ||
           (by_blanks() && IsBlank(*p));
  }

  // Past the line end at `p`, if there is one.
  const char* PastLineEnd(const char* p) const {
    if (p == end_) return p;
    return p + (*p == '\r' && p + 1 != end_ && p[1] == '\n' ? 2 : 1);
  }

  void SkipLine() {
    cursor_ = PastLineEnd(std::find_if(cursor_, end_, IsLineEnd));
    ++line_;
  }

  bool AtMark() const {
    const std::string_view rest(cursor_,
                                static_cast<std::size_t>(end_ - cursor_));
    return rest.starts_with(kFormulaMark) &&
           rest.size() > kFormulaMark.size() &&
           IsLineEnd(rest[kFormulaMark.size()]);
  }

  std::string_view TextOf(std::string_view field) const {
    return has_apostrophes_ ? WithoutApostrophe(field) : field;
  }

  bool AtBlankLine() const {
    const char* const p = SkipBlanks(cursor_);
    return p != end_ ? IsLineEnd(*p) : cursor_ != end_;
  }

  // ---- Before the data.

  void CheckText() {
    const std::string_view text(cursor_,
                                static_cast<std::size_t>(end_ - cursor_));
    if (text.starts_with("\xEF\xBB\xBF")) cursor_ += 3;
    const std::size_t nul = text.find('\0');
    if (nul != std::string_view::npos) {
      ThrowAt(1 + CountLineEnds(text.data(), text.data() + nul),
              "NUL byte; this is no text file: save it as CSV in UTF-8");
    }
    if (cursor_ == end_) {
      throw InputError(File() +
                       ": the file is empty; it needs a line of column names "
                       "and rows of numbers below");
    }
  }

  // "sep=;", as spreadsheets write and read it above the header.
  void TakeSeparatorLine() {
    const char* const line_end = std::find_if(cursor_, end_, IsLineEnd);
    std::string_view line = {cursor_,
                             static_cast<std::size_t>(line_end - cursor_)};
    if (line.size() > 2 && line.front() == '"' && line.back() == '"') {
      line = line.substr(1, line.size() - 2);
    }
    constexpr std::string_view kSeparator = "sep=";
    if (line.size() != kSeparator.size() + 1 ||
        !StartsWithIgnoringCase(line, kSeparator)) {
      return;
    }
    delimiter_ = line.back();
    SkipLine();
  }

  void SkipToHeader() {
    while (cursor_ != end_ && (*cursor_ == '#' || AtBlankLine())) {
      if (*cursor_ == '#') comment_before_header_ = line_;
      if (line_ == 1 && AtMark()) has_apostrophes_ = true;
      SkipLine();
    }
    if (cursor_ == end_) {
      throw InputError(File() +
                       ": no header, only comments or blank lines; it needs a "
                       "line of column names and rows of numbers below");
    }
  }

  // Cells of the line at `p` that blanks part.
  static std::size_t NumBlankFields(const char* p, const char* end) {
    std::size_t count = 0;
    bool inside = false;
    for (; p != end && !IsLineEnd(*p); ++p) {
      const bool blank = *p == ' ' || *p == '\t';
      count += !blank && !inside ? 1 : 0;
      inside = !blank;
    }
    return count;
  }

  // Candidate delimiters outside quotes in the record at *p, which moves to
  // the next. A quote counts where it could begin a cell of some delimiter.
  DelimiterCounts CountDelimiters(const char** p) const {
    DelimiterCounts counts{};
    bool quoted = false;
    bool at_start = true;
    for (; *p != end_; ++*p) {
      const char c = **p;
      if (quoted) {
        quoted = c != '"';
        continue;
      }
      if (IsLineEnd(c)) break;
      const auto found = std::find(kDelimiters.begin(), kDelimiters.end(), c);
      if (found != kDelimiters.end()) {
        ++counts[static_cast<std::size_t>(found - kDelimiters.begin())];
        at_start = true;
      } else if (c == '"' && (at_start || (*p)[-1] == '"')) {
        quoted = true;  // opens, or goes on after a doubled quote
        at_start = false;
      } else if (c != ' ') {
        at_start = false;
      }
    }
    *p = PastLineEnd(*p);
    return counts;
  }

  // The record after this one and after comments and blank lines.
  const char* NextRecord(const char* p) const {
    while (p != end_ && (*p == '#' || IsLineEnd(*p))) {
      p = PastLineEnd(std::find_if(p, end_, IsLineEnd));
    }
    return p;
  }

  void ChooseDelimiter() {
    const char* p = cursor_;
    const DelimiterCounts in_header = CountDelimiters(&p);
    p = NextRecord(p);
    const char* const row = p;
    const DelimiterCounts in_row = CountDelimiters(&p);
    std::pair<bool, std::size_t> best{false, 0};
    for (std::size_t i = 0; i < kDelimiters.size(); ++i) {
      if (in_header[i] == 0) continue;
      const std::pair score{in_header[i] == in_row[i], in_header[i]};
      if (score > best) {
        best = score;
        delimiter_ = kDelimiters[i];
      }
    }
    if (delimiter_ != kNoDelimiter) return;
    const std::size_t fields = NumBlankFields(cursor_, end_);
    if (fields > 1 && fields == NumBlankFields(row, end_) &&
        (p == end_ || fields == NumBlankFields(NextRecord(p), end_))) {
      delimiter_ = ' ';
      return;
    }
    // A title above the header has nothing of what parts the rows.
    const DelimiterCounts in_next = CountDelimiters(&(p = NextRecord(p)));
    const auto* const most = std::ranges::max_element(in_row);
    if (*most > 1 && in_row == in_next) {
      delimiter_ = kDelimiters[static_cast<std::size_t>(most - in_row.begin())];
    }
  }

  void ReadHeader() {
    const std::size_t line = line_;
    std::unordered_map<std::string, std::size_t> numbers;  // by name, 1-based
    for (bool more = true; more;) {
      const std::size_t number = table_.columns.size() + 1;
      std::string name = AsUtf8(TextOf(NextField()));
      more = PassCellEnd();
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
      ThrowAt(line_,
              "the unit " + QuotedText(unit) + " of column " +
                  QuotedName(name) +
                  " is another than in its name; correct "
                  "one of them");
    }
    return name + " [" + std::string(unit) + "]";
  }

  // The cells of the record at the cursor, which stays.
  std::vector<std::string> PeekRecord(std::size_t record) {
    const auto saved = std::pair(cursor_, line_);
    std::vector<std::string> cells;
    try {
      for (std::size_t i = 0; i <= record; ++i) {
        cells.clear();
        if (cursor_ == end_) break;
        do {
          cells.push_back(AsUtf8(TextOf(NextField())));
        } while (PassCellEnd());
      }
    } catch (const InputError&) {
      cells.clear();  // to be told where the row is read
    }
    std::tie(cursor_, line_) = saved;
    return cells;
  }

  // Units below the names, "mm, degC, [um]", each over a number or nothing:
  // they become part of the names.
  void TakeUnitsRow() {
    if (cursor_ == end_ || *cursor_ == '#' || AtBlankLine()) return;
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
    SkipLine();
  }

  // Rows at the end that hold delimiters alone, as spreadsheets leave them.
  void LeaveEmptyEnd() {
    const char* last = end_;
    while (last != cursor_ && (IsBlank(last[-1]) || IsLineEnd(last[-1]) ||
                               last[-1] == delimiter_)) {
      --last;
    }
    end_ = PastLineEnd(std::find_if(last, end_, IsLineEnd));
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
    std::ptrdiff_t lines = std::count(cursor_, end_, '\n');
    if (lines == 0) lines = std::count(cursor_, end_, '\r');
    const auto columns = static_cast<std::ptrdiff_t>(table_.columns.size());
    const auto rows = static_cast<std::size_t>(
        std::min(lines, (end_ - cursor_) / columns) + 1);
    for (CsvColumn& column : table_.columns) column.values.reserve(rows);
  }

  // ---- The data.

  void ReadRows() {
    in_data_ = true;
    std::size_t blank_line = 0;
    while (cursor_ != end_) {
      if (*cursor_ == '#') {
        SkipLine();
      } else if (AtBlankLine()) {
        if (blank_line == 0) blank_line = line_;
        SkipLine();
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
    const std::size_t line = line_;
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
    if (column_ == table_.columns.size()) {
      const char* rest = cursor_;
      while (rest != end_ && (IsBlank(*rest) || *rest == delimiter_)) ++rest;
      if (rest != end_ && !IsLineEnd(*rest)) return false;
      cursor_ = PastLineEnd(rest);
      ++line_;
      return true;
    }
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
      for (NextField(); PassCellEnd(); NextField()) ++found;
    }
    std::string what =
        std::to_string(found) + (found == 1 ? " field" : " fields") +
        " where the header has " + std::to_string(table_.columns.size()) +
        "; complete the row or remove it";
    if (table_.num_rows == 0 && table_.columns.size() == 1) {
      what +=
          ", or, where the names stand further down, start the lines above "
          "them with #";
    } else if (delimiter_ == ',' && found > table_.columns.size()) {
      what +=
          " (if these are decimal commas, write decimal points or separate "
          "the columns with ; or tab)";
    }
    ThrowAt(line, what);
  }

  // Reads a cell into its column; false where the row ends with it.
  bool ReadCell() {
    CsvColumn& column = table_.columns[column_];
    // Most cells are plain numbers, and from_chars finds their end by itself.
    const char* const start = SkipBlanks(cursor_);
    double value = 0.0;
    const auto [stop, error] = std::from_chars(start, end_, value);
    if (error == std::errc() && std::isfinite(value)) {
      const char* const after = SkipBlanks(stop);
      if (EndsCell(after)) {
        StoreNumber({value, false, HasPoint(start, stop)}, &column);
        cursor_ = after;
        return PassCellEnd();
      }
    }
    const std::string_view field = NextField();
    if (NumberForm form{}; ReadNumber(field, &form)) {
      StoreNumber(form, &column);
    } else {
      StoreText(field, &column);
    }
    return PassCellEnd();
  }

  struct NumberForm {
    double value;
    bool decimal_comma;
    bool decimal_point;
  };

  static bool HasPoint(const char* begin, const char* end) {
    return std::find(begin, end, '.') != end;
  }

  bool ReadNumber(std::string_view field, NumberForm* form) {
    form->decimal_point = HasPoint(field.data(), field.data() + field.size());
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

  // Past the delimiter (true) or line end (false) that ended a cell.
  bool PassCellEnd() {
    if (by_blanks()) cursor_ = SkipBlanks(cursor_);
    if (cursor_ == end_) return false;
    if (by_blanks() && !IsLineEnd(*cursor_)) return true;
    if (*cursor_ == delimiter_) {
      ++cursor_;
      return true;
    }
    cursor_ = PastLineEnd(cursor_);
    ++line_;
    return false;
  }

  // Text of the cell at the cursor, trimmed and without its quotes; good until
  // the next call. The cursor comes to rest on what ends the cell.
  std::string_view NextField() {
    const char* const start = SkipBlanks(cursor_);
    if (start != end_ && *start == '"') {
      cursor_ = start + 1;
      return Trimmed(QuotedField());
    }
    cursor_ = start;
    while (!EndsCell(cursor_)) ++cursor_;
    return Trimmed({start, static_cast<std::size_t>(cursor_ - start)});
  }

  // The cursor stands after the opening quote.
  std::string_view QuotedField() {
    const std::size_t opening_line = line_;
    const char* const begin = cursor_;
    unquoted_.clear();
    for (const char* part = begin;;) {
      const auto rest = static_cast<std::size_t>(end_ - part);
      const char* const quote =
          rest == 0 ? nullptr
                    : static_cast<const char*>(std::memchr(part, '"', rest));
      if (quote == nullptr) {
        ThrowInCell(opening_line,
                    "the quote that opens here is never closed; close it, or "
                    "remove it");
      }
      if (quote + 1 != end_ && quote[1] == '"') {
        unquoted_.append(part, quote + 1);
        part = quote + 2;
        continue;
      }
      line_ += CountLineEnds(begin, quote);
      cursor_ = SkipBlanks(quote + 1);
      if (!EndsCell(cursor_)) {
        ThrowInCell(line_,
                    "text after the closing quote of the cell that opened on "
                    "line " +
                        std::to_string(opening_line) +
                        "; a quote inside quotes is written twice");
      }
      const std::string_view last(part, static_cast<std::size_t>(quote - part));
      if (part == begin) return last;
      unquoted_ += last;
      return unquoted_;
    }
  }

  const char* cursor_;
  const char* end_;
  std::size_t line_ = 1;  // of the cursor
  char delimiter_ = kNoDelimiter;
  bool decimal_comma_ = false;
  bool has_apostrophes_ = false;           // kFormulaMark stands at the top
  std::size_t comment_before_header_ = 0;  // line of the last one, or 0
  std::size_t header_line_ = 0;
  bool in_data_ = false;
  std::size_t column_ = 0;        // being read, within the data
  std::vector<TextIndex> texts_;  // (columns)
  std::string unquoted_;          // scratch: cell with doubled quotes undone
  std::string point_form_;        // scratch: cell with its comma made a point
  CsvTable table_;
};

}  // namespace

CsvTable ParseCsv(std::string_view text, const std::string& name) {
  if (IsGzip(text)) {
    std::string unpacked;
    try {
      unpacked = Gunzip(text, kMostTextOfPrograms);
    } catch (const InputError& error) {
      throw InputError(PrintablePath(name) + ": " + error.what());
    }
    return ParseCsv(IsGzip(unpacked) ? "" : unpacked, name);
  }
  const std::string converted = TextOfFile(text, name);
  return Parser(converted.empty() ? text : converted, name).Parse();
}

}  // namespace errmap::data
