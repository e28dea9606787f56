#include "data/tables/csv_cells.h"

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

bool CsvCells::PassEmptyRest() {
  const char* rest = cursor_;
  while (rest != end_ && (IsBlank(*rest) || *rest == delimiter)) ++rest;
  if (rest != end_ && !IsLineEnd(*rest)) return false;
  cursor_ = PastLineEnd(rest, end_);
  ++line_;
  return true;
}

std::string_view CsvCells::Next() {
  const char* const start = SkipBlanks(cursor_);
  if (start != end_ && *start == '"') {
    cursor_ = start + 1;
    return Trimmed(Quoted());
  }
  cursor_ = start;
  while (!EndsCell(cursor_)) ++cursor_;
  return Trimmed({start, static_cast<std::size_t>(cursor_ - start)});
}

// The cursor stands after the opening quote.
std::string_view CsvCells::Quoted() {
  const std::size_t opening_line = line_;
  const char* const begin = cursor_;
  unquoted_.clear();
  for (const char* part = begin;;) {
    const auto rest = static_cast<std::size_t>(end_ - part);
    const char* const quote =
        rest == 0 ? nullptr
                  : static_cast<const char*>(std::memchr(part, '"', rest));
    if (quote == nullptr) {
      throw InputError(place_(opening_line) +
                       ": the quote that opens here is never closed; close "
                       "it, or remove it");
    }
    if (quote + 1 != end_ && quote[1] == '"') {
      unquoted_.append(part, quote + 1);
      part = quote + 2;
      continue;
    }
    line_ += CountLineEnds({begin, static_cast<std::size_t>(quote - begin)});
    cursor_ = SkipBlanks(quote + 1);
    if (!EndsCell(cursor_)) {
      throw InputError(place_(line_) +
                       ": text after the closing quote of the cell that "
                       "opened on line " +
                       std::to_string(opening_line) +
                       "; a quote inside quotes is written twice");
    }
    const std::string_view last(part, static_cast<std::size_t>(quote - part));
    if (part == begin) return last;
    unquoted_ += last;
    return unquoted_;
  }
}

}  // namespace errmap::data
