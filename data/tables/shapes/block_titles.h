#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// A line of words or a comment, and the row that follows it.
struct TitleLine {
  std::size_t row = 0;
  std::string text;
};

/// True if a line of words contains a date.
bool HoldsDate(const std::string& text);

/// True if a line names the day, session, run or cycle that follows.
bool NamesSession(const std::string& text);

/// Makes a column from lines that divide a table's rows into blocks: "date" if
/// each has another date, else "session", "day", "cycle" or "run" by their
/// words. Every block has such a line, including the first. The lines name
/// days, sessions, runs or cycles and differ only in their numbers, or the
/// names of the columns are repeated below each. For "day 1 run 1", "day 1 run
/// 2", "day 2 run 1" it is the day. Adds a remark, also if lines that name
/// sessions give no column. `names_again`: how often the names are repeated
/// between the rows.
void PartByTitles(const std::vector<TitleLine>& lines,
                  std::size_t names_again,
                  CsvTable* table);

/// Consecutive blank lines, or rows of empty cells.
struct BlankLines {
  std::size_t row = 0;   // of the table, below them
  std::size_t line = 0;  // of the first in the file
  std::size_t count = 0;
};

/// Adds a column "block" that numbers the runs of rows between blank lines. If
/// some places have more blank lines than others, only these divide, as between
/// gnuplot's data sets. Makes none if a column has that name, only one place is
/// blank, or a block has fewer than four rows.
void PartByBlankLines(const std::vector<BlankLines>& blanks, CsvTable* table);

}  // namespace errmap::data
