#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "data/input_error.h"

namespace errmap::data {

inline bool IsLineEnd(char c) { return c == '\n' || c == '\r'; }

/// Skips the line end at `p`, if there is one: LF, CRLF and a lone CR (old
/// Macintosh) each end one line.
inline const char* PastLineEnd(const char* p, const char* end) {
  if (p == end) return p;
  return p + (*p == '\r' && p + 1 != end && p[1] == '\n' ? 2 : 1);
}

/// Reads the text of a CSV file cell by cell: a cursor, its line, and the
/// characters that end a cell. It handles quotes, but not the meaning of a
/// cell.
class CsvCells {
 public:
  /// The parser refuses NUL, so this delimiter never occurs.
  static constexpr char kNoDelimiter = '\0';

  /// `text` must outlive it; `place` begins a message about a line.
  CsvCells(std::string_view text,
           std::function<std::string(std::size_t line)> place)
      : cursor_(text.data()),
        end_(text.data() + text.size()),
        place_(std::move(place)) {}

  // ---- Where it is.

  bool at_end() const { return cursor_ == end_; }
  char front() const { return *cursor_; }  // not at the end
  std::string_view rest() const {
    return {cursor_, static_cast<std::size_t>(end_ - cursor_)};
  }
  std::size_t line() const { return line_; }

  struct Position {
    const char* cursor;
    std::size_t line;
  };
  Position position() const { return {cursor_, line_}; }
  void GoTo(const Position& position) {
    cursor_ = position.cursor;
    line_ = position.line;
  }

  // ---- What parts cells.

  /// As delimiter, a blank stands for any number of blanks.
  char delimiter = kNoDelimiter;
  /// Number of cells of a row, or 0 if unknown. If a quoted cell contains a
  /// line with this many cells, its closing quote is missing.
  std::size_t width = 0;

  // ---- Lines.

  bool AtBlankLine() const;
  void SkipLine();
  /// Skips a byte order mark.
  void SkipBytes(std::size_t count) { cursor_ += count; }
  /// Removes final rows of delimiters only, which spreadsheets leave.
  void LeaveEmptyEnd();

  // ---- Cells.

  /// Returns the text of the cell at the cursor, trimmed and without its
  /// quotes; valid until the next call. The cursor stops at the character that
  /// ends the cell. A quote inside a quoted cell that is not followed by the
  /// end of a cell is part of its text. Throws InputError for a quote that is
  /// never closed, or not within its row.
  std::string_view Next();

  /// Returns the text of a plain number, as Next would, or an empty text (the
  /// cursor stays). A fast path: most cells are plain numbers, and from_chars
  /// finds their end.
  std::string_view NextNumber(double* value) {
    const char* const start = SkipBlanks(cursor_);
    const auto [stop, error] = std::from_chars(start, end_, *value);
    if (error != std::errc() || !std::isfinite(*value)) return {};
    const char* const after = SkipBlanks(stop);
    if (!EndsCell(after)) return {};
    cursor_ = after;
    return {start, static_cast<std::size_t>(stop - start)};
  }

  /// Skips the delimiter (true) or line end (false) that ended a cell.
  bool PassEnd() {
    if (by_blanks()) cursor_ = SkipBlanks(cursor_);
    if (cursor_ == end_) return false;
    if (by_blanks() && !IsLineEnd(*cursor_)) return true;
    if (*cursor_ == delimiter) {
      ++cursor_;
      return true;
    }
    cursor_ = PastLineEnd(cursor_, end_);
    ++line_;
    return false;
  }

  /// Throws InputError that begins with the place of the line.
  [[noreturn]] void ThrowAt(std::size_t line, const std::string& what) const {
    throw InputError(place_(line) + ": " + what);
  }

  /// Removes the last line, which starts at `start`.
  void LeaveOutEnd(const char* start) { end_ = start; }

 private:
  bool IsBlank(char c) const {
    return c == ' ' || (c == '\t' && delimiter != '\t');
  }
  bool by_blanks() const { return delimiter == ' '; }

  const char* SkipBlanks(const char* p) const {
    while (p != end_ && IsBlank(*p)) ++p;
    return p;
  }

  bool EndsCell(const char* p) const {
    return p == end_ || *p == delimiter || IsLineEnd(*p) ||
           (by_blanks() && IsBlank(*p));
  }

  std::string_view Quoted();
  [[noreturn]] void ThrowNeverClosed(std::size_t line) const;
  bool RunsOverRows(std::string_view cell) const;

  const char* cursor_;
  const char* end_;
  std::size_t line_ = 1;  // of the cursor
  std::function<std::string(std::size_t line)> place_;
  std::string unquoted_;  // scratch: cell with doubled quotes undone
};

/// Returns how many lines end within a text.
std::size_t CountLineEnds(std::string_view text);

/// A cell that is a number, and its notation.
struct NumberForm {
  double value = 0.0;
  bool decimal_comma = false;
  bool decimal_point = false;
};

/// Reads a cell that is one finite number, with a decimal comma if that is
/// allowed. A second comma makes it a text.
bool ReadNumberForm(std::string_view cell, bool may_be_comma, NumberForm* form);

/// Returns cell text without blanks at its ends, including no-break and thin
/// ones.
std::string_view TrimmedCell(std::string_view text);

/// A last line that ends inside a number, because of an incomplete copy or a
/// full disk.
struct CutLine {
  const char* start;   // where the line begins
  std::string number;  // what is left of its last cell
};

/// Looks for a cut line at the end of a table's rows. It has no line end, and
/// its last number has fewer decimals than each of the many numbers above it.
std::optional<CutLine> FindCutLine(std::string_view rows, char delimiter);

}  // namespace errmap::data
