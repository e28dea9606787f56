#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// A line of words or a comment, and the row that comes next.
struct TitleLine {
  std::size_t row = 0;
  std::string text;
};

/// Whether a line of words has a date in it.
bool HoldsDate(const std::string& text);

/// Whether a line says which day, session, run or cycle follows.
bool NamesSession(const std::string& text);

/// Makes of lines that part a table's rows into blocks a column: "date" where
/// each has another date, else "session", "day", "cycle" or "run" by what they
/// say. Each block has one, the first one too; they name days, sessions, runs
/// or cycles and differ in their numbers alone, or the names of the columns
/// stand below each. Of "day 1 run 1", "day 1 run 2", "day 2 run 1" it is the
/// day. Says so in a remark, and where lines that name sessions make none.
/// `names_again`: how often the names stand between the rows.
void PartByTitles(const std::vector<TitleLine>& lines,
                  std::size_t names_again,
                  CsvTable* table);

/// Blank lines, or rows of empty cells, in one place.
struct BlankLines {
  std::size_t row = 0;   // of the table, below them
  std::size_t line = 0;  // of the first in the file
  std::size_t count = 0;
};

/// Numbers the rows between blank lines in a column "block"; where some places
/// have more of them, as gnuplot parts its data sets, between those. None where
/// a column has that name, one place alone is blank, or a block has fewer than
/// four rows.
void PartByBlankLines(const std::vector<BlankLines>& blanks, CsvTable* table);

}  // namespace errmap::data
