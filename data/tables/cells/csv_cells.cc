#include "data/tables/cells/csv_cells.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "data/input_error.h"
#include "data/text.h"

namespace errmap::data {

std::size_t CountLineEnds(std::string_view text) {
  const char* const end = text.data() + text.size();
  std::size_t count = 0;
  for (const char* p = text.data(); p != end; ++p) {
    const bool before_lf = *p == '\r' && p + 1 != end && p[1] == '\n';
    if (IsLineEnd(*p) && !before_lf) ++count;
  }
  return count;
}

bool CsvCells::AtBlankLine() const {
  const char* const p = SkipBlanks(cursor_);
  return p != end_ ? IsLineEnd(*p) : cursor_ != end_;
}

void CsvCells::SkipLine() {
  cursor_ = PastLineEnd(std::find_if(cursor_, end_, IsLineEnd), end_);
  ++line_;
}

void CsvCells::LeaveEmptyEnd() {
  const char* last = end_;
  while (last != cursor_ &&
         (IsBlank(last[-1]) || IsLineEnd(last[-1]) || last[-1] == delimiter)) {
    --last;
  }
  end_ = PastLineEnd(std::find_if(last, end_, IsLineEnd), end_);
}

std::string_view CsvCells::Next() {
  const char* const start = SkipBlanks(cursor_);
  if (start != end_ && *start == '"') {
    cursor_ = start + 1;
    return TrimmedCell(Quoted());
  }
  cursor_ = start;
  while (!EndsCell(cursor_)) ++cursor_;
  return TrimmedCell({start, static_cast<std::size_t>(cursor_ - start)});
}

void CsvCells::ThrowNeverClosed(std::size_t line) const {
  ThrowAt(line,
          "the quote that opens here is never closed; close it, or remove it");
}

// Whether one of the lines after the first has as many cells as a row.
bool CsvCells::RunsOverRows(std::string_view cell) const {
  if (width < 2) return false;
  const char* const end = cell.data() + cell.size();
  const char* line = std::find_if(cell.data(), end, IsLineEnd);
  while (line != end) {
    line = PastLineEnd(line, end);
    const char* const next = std::find_if(line, end, IsLineEnd);
    if (static_cast<std::size_t>(std::count(line, next, delimiter)) + 1 >=
        width) {
      return true;
    }
    line = next;
  }
  return false;
}

// The cursor stands after the opening quote.
std::string_view CsvCells::Quoted() {
  const std::size_t opening_line = line_;
  const char* const begin = cursor_;
  bool has_bare_quote = false;
  unquoted_.clear();
  for (const char* part = begin;;) {
    const auto rest = static_cast<std::size_t>(end_ - part);
    const char* const quote =
        rest == 0 ? nullptr
                  : static_cast<const char*>(std::memchr(part, '"', rest));
    if (quote == nullptr) ThrowNeverClosed(opening_line);
    const bool is_double = quote + 1 != end_ && quote[1] == '"';
    // A blank that parts cells ends this one.
    const char* const after = by_blanks() ? quote + 1 : SkipBlanks(quote + 1);
    if (is_double || !EndsCell(after)) {
      has_bare_quote = has_bare_quote || !is_double;
      unquoted_.append(part, quote + 1);
      part = quote + (is_double ? 2 : 1);
      continue;
    }
    const std::string_view all(begin, static_cast<std::size_t>(quote - begin));
    const std::size_t line_ends = CountLineEnds(all);
    if (line_ends > 0 && (has_bare_quote || RunsOverRows(all))) {
      ThrowNeverClosed(opening_line);
    }
    line_ += line_ends;
    cursor_ = after;
    const std::string_view last(part, static_cast<std::size_t>(quote - part));
    if (part == begin) return last;
    unquoted_ += last;
    return unquoted_;
  }
}

bool ReadNumberForm(std::string_view cell,
                    bool may_be_comma,
                    NumberForm* form) {
  form->decimal_point = cell.find('.') != std::string_view::npos;
  const std::size_t comma = may_be_comma && !form->decimal_point
                                ? cell.find(',')
                                : std::string_view::npos;
  form->decimal_comma = comma != std::string_view::npos;
  if (!form->decimal_comma) return ParseNumber(cell, &form->value);
  std::string with_point(cell);
  with_point[comma] = '.';
  return ParseNumber(with_point, &form->value);
}

namespace {

// Blanks that programs put between a number and what stands beside it: no-break
// space, figure space, thin spaces, and the mark that begins a file.
constexpr auto kBlanks = std::to_array<std::string_view>({" ",
                                                          "\t",
                                                          "\xC2\xA0",
                                                          "\xE2\x80\x87",
                                                          "\xE2\x80\x89",
                                                          "\xE2\x80\xAF",
                                                          "\xEF\xBB\xBF"});
constexpr char kLatinBlank = '\xA0';

bool IsAscii(char c) { return static_cast<unsigned char>(c) < 0x80U; }

}  // namespace

std::string_view TrimmedCell(std::string_view text) {
  for (bool more = true; more && !text.empty();) {
    more = false;
    for (const std::string_view blank : kBlanks) {
      if (text.starts_with(blank)) {
        text.remove_prefix(blank.size());
        more = true;
      }
      if (text.ends_with(blank)) {
        text.remove_suffix(blank.size());
        more = true;
      }
    }
    if (text.starts_with(kLatinBlank)) {
      text.remove_prefix(1);
      more = true;
    }
    if (text.size() > 1 && text.back() == kLatinBlank &&
        IsAscii(text[text.size() - 2])) {
      text.remove_suffix(1);
      more = true;
    }
  }
  return text;
}

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
