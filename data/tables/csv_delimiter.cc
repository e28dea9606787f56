// FindDelimiter of data/tables/csv_cells.h.

#include <algorithm>
#include <array>
#include <utility>

#include "data/tables/csv_cells.h"

namespace errmap::data {
namespace {

// Where all else is equal the rarer character wins: commas and semicolons
// occur in names.
constexpr std::array<char, 4> kDelimiters = {'\t', ';', '|', ','};
using DelimiterCounts = std::array<std::size_t, kDelimiters.size()>;

// Cells of the line at `p` that blanks part.
std::size_t NumBlankFields(const char* p, const char* end) {
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
DelimiterCounts CountDelimiters(const char** p, const char* end) {
  DelimiterCounts counts{};
  bool quoted = false;
  bool at_start = true;
  for (; *p != end; ++*p) {
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
  *p = PastLineEnd(*p, end);
  return counts;
}

// The record after this one and after comments and blank lines.
const char* NextRecord(const char* p, const char* end) {
  while (p != end && (*p == '#' || IsLineEnd(*p))) {
    p = PastLineEnd(std::find_if(p, end, IsLineEnd), end);
  }
  return p;
}

}  // namespace

char FindDelimiter(std::string_view text) {
  const char* const end = text.data() + text.size();
  const char* p = text.data();
  const DelimiterCounts in_header = CountDelimiters(&p, end);
  p = NextRecord(p, end);
  const char* const row = p;
  const DelimiterCounts in_row = CountDelimiters(&p, end);
  std::pair<bool, std::size_t> best{false, 0};
  char delimiter = CsvCells::kNoDelimiter;
  for (std::size_t i = 0; i < kDelimiters.size(); ++i) {
    if (in_header[i] == 0) continue;
    const std::pair score{in_header[i] == in_row[i], in_header[i]};
    if (score > best) {
      best = score;
      delimiter = kDelimiters[i];
    }
  }
  if (delimiter != CsvCells::kNoDelimiter) return delimiter;
  const std::size_t fields = NumBlankFields(text.data(), end);
  if (fields > 1 && fields == NumBlankFields(row, end) &&
      (p == end || fields == NumBlankFields(NextRecord(p, end), end))) {
    return ' ';
  }
  // A title above the header has nothing of what parts the rows.
  const DelimiterCounts in_next =
      CountDelimiters(&(p = NextRecord(p, end)), end);
  const auto* const most = std::ranges::max_element(in_row);
  return *most > 1 && in_row == in_next
             ? kDelimiters[static_cast<std::size_t>(most - in_row.begin())]
             : CsvCells::kNoDelimiter;
}

}  // namespace errmap::data
