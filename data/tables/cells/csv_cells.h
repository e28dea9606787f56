#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "data/input_error.h"

namespace errmap::data {

inline bool IsLineEnd(char c) { return c == '\n' || c == '\r'; }

/// Past the line end at `p`, if there is one: LF, CRLF and a lone CR (old
/// Macintosh) each end one line.
inline const char* PastLineEnd(const char* p, const char* end) {
  if (p == end) return p;
  return p + (*p == '\r' && p + 1 != end && p[1] == '\n' ? 2 : 1);
}

/// The text of a CSV file cell by cell: a cursor, its line, and what ends a
/// cell. Knows quotes, not what a cell means.
class CsvCells {
 public:
  /// No cell can hold a NUL (the parser refuses them), so none ends at this.
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

  /// ' ' stands for any number of blanks.
  char delimiter = kNoDelimiter;
  /// Cells of a row, or 0 where that is not known yet: a quoted cell with a
  /// line of so many in it is one that somebody forgot to close.
  std::size_t width = 0;

  // ---- Lines.

  bool AtBlankLine() const;
  void SkipLine();
  /// A byte order mark, of which no line is made.
  void SkipBytes(std::size_t count) { cursor_ += count; }
  /// Leaves out the rows at the end that hold delimiters alone, as
  /// spreadsheets leave them.
  void LeaveEmptyEnd();

  // ---- Cells.

  /// Text of the cell at the cursor, trimmed and without its quotes; good until
  /// the next call. The cursor comes to rest on what ends the cell. A quote
  /// inside a quoted cell that nothing ends after is part of its text. Throws
  /// InputError for a quote that is never closed, or not within its row.
  std::string_view Next();

  /// Most cells are plain numbers, and from_chars finds their end by itself:
  /// the text of one, taken like Next's, or empty (the cursor stays).
  std::string_view NextNumber(double* value) {
    const char* const start = SkipBlanks(cursor_);
    const auto [stop, error] = std::from_chars(start, end_, *value);
    if (error != std::errc() || !std::isfinite(*value)) return {};
    const char* const after = SkipBlanks(stop);
    if (!EndsCell(after)) return {};
    cursor_ = after;
    return {start, static_cast<std::size_t>(stop - start)};
  }

  /// Past the delimiter (true) or line end (false) that ended a cell.
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

  /// Leaves out the line at the end, which starts at `start`.
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

/// How many lines end within a text.
std::size_t CountLineEnds(std::string_view text);

/// A cell that is a number, and how it was written.
struct NumberForm {
  double value = 0.0;
  bool decimal_comma = false;
  bool decimal_point = false;
};

/// Whether a cell is one finite number, with a decimal comma where that may be.
/// A second comma makes it a text.
bool ReadNumberForm(std::string_view cell, bool may_be_comma, NumberForm* form);

/// Cell text without blanks at its ends, no-break and thin ones included.
std::string_view TrimmedCell(std::string_view text);

}  // namespace errmap::data
