#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/column_values.h"
#include "data/input_error.h"

namespace errmap::data {

/// One column as the file has it. Numbers are parsed while reading; what is
/// not a finite number is kept apart as text, once per distinct text.
struct CsvColumn {
  std::string name;
  bool has_name = true;      // false: the header left it empty, `name` is ours
  ColumnValues values = {};  // (rows) quiet NaN where `exceptions` has the row
  /// Cells that are no finite number, ascending by row: (row, index in texts).
  std::vector<std::pair<std::size_t, std::uint32_t>> exceptions = {};
  std::vector<std::string> texts =
      {};  // distinct texts of those cells, trimmed
  /// First rows written with a decimal comma and with a decimal point, or -1.
  std::ptrdiff_t first_decimal_comma = -1;
  std::ptrdiff_t first_decimal_point = -1;

  /// True where no cell is a number: fit for groups, never an input.
  bool is_text() const { return exceptions.size() == values.size(); }
  /// The text of a cell; null where it is a number.
  const std::string* TextAt(std::size_t row) const;
  /// That a number of this row is written with a decimal comma or point.
  void NoteMarks(std::size_t row, bool comma, bool point) {
    const auto at = static_cast<std::ptrdiff_t>(row);
    if (comma && first_decimal_comma < 0) first_decimal_comma = at;
    if (point && first_decimal_point < 0) first_decimal_point = at;
  }
};

/// A CSV file, or several as one: named columns of equal length.
struct CsvTable {
  std::string file;  // as given; begins every message about it
  std::vector<CsvColumn> columns;
  std::size_t num_rows = 0;

  /// Index of the column of that name, or -1.
  std::ptrdiff_t Find(std::string_view name) const;
  /// The column of an index, such as Find's, that is at least 0.
  template <typename Index>
  const CsvColumn& At(Index index) const {
    return columns[static_cast<std::size_t>(index)];
  }
  /// 1-based line of the file on which data row `row` (0-based) starts.
  std::size_t LineOfRow(std::size_t row) const;
  /// "xdown.csv: line 18 (data row 16), column 't3_degC'", to begin a message;
  /// a table in memory has no lines.
  std::string Where(std::size_t row, std::string_view column) const;
  /// Text of a cell: its exception text, else the number in shortest form.
  std::string CellText(const CsvColumn& column, std::size_t row) const;

  /// Runs of rows on successive lines: (first row, its line), ascending; rows
  /// after comments, quoted line breaks or the header start a new run.
  std::vector<std::pair<std::size_t, std::size_t>> line_runs;
  /// Of several files: (first row, file as given), ascending; else empty.
  std::vector<std::pair<std::size_t, std::string>> parts;

  /// Lines and comments above the table, and lines of words among its rows: a
  /// program's name, a date, the axis.
  std::vector<std::string> titles;
  /// What was not plain in the file and how it was read, one line each, to be
  /// told to whoever uses the table.
  std::vector<std::string> remarks;
};

/// What becomes of rows that have another number of cells than the others:
/// refused, all at once; the same, and the message names the option of
/// MissingPolicy that leaves them out; left out with a remark.
enum class OddRows { kRefuse, kOffer, kLeaveOut };

/// Reads a CSV file: `,` `;` `|`, tab or blanks between cells, found from its
/// rows; quotes as RFC 4180 has them, those inside a cell that nobody doubled
/// too; decimal comma where no comma parts cells; UTF-8 byte order mark, CRLF,
/// lines starting with `#`, and blank lines at the end are passed over. Text
/// that is no valid UTF-8 is taken for Latin-1, or with a remark for what makes
/// more known words (tables/text_encoding.h), and converted; what begins as
/// gzip does is unpacked first, up to kMostTextOfPrograms; of an xlsx file a
/// sheet is read ("book.xlsx:Day 2", formats/spreadsheet.h). Linear time, about
/// twice the file's memory; never looks at the locale.
///
/// Read with a remark: lines above the table (`titles`), no line of names
/// (column_1, ...), names in a comment, in two rows or above channels, a name
/// that comes twice (x, x_2), columns that no row reaches, blank lines, names
/// again and lines of words between rows, which become a column where they part
/// days or runs; points that part thousands (three digits behind each), a last
/// line cut off in mid number, which is left out; a column for each position
/// ("e@-215.9mm_um", "X=25 mm"), run ("Run 1 up [um]") or way ("Error up [um]")
/// becomes a row for each reading, and rows of one reading or of one variable
/// each become such rows, too; numbers as people write them (loose_numbers.h),
/// single quotes, columns set apart by blanks (tables/rewritten_text.h).
/// An unnamed column is called column_N (`has_name` is false).
///
/// Throws InputError: unreadable file, empty file, header alone, a number where
/// a name should be, rows of another length (OddRows), another table below, a
/// blank line in a single column, quote never closed, NUL byte, more columns
/// than 65536. Cells that are no numbers are not judged here (see MakeDataset).
CsvTable ReadCsv(const std::string& path, OddRows odd = OddRows::kRefuse);

/// The same, and what Sha256OfFile says of the file, which is read once.
CsvTable ReadCsv(const std::string& path,
                 std::string* sha256,
                 OddRows odd = OddRows::kRefuse);

/// The same from text in memory; `name` stands for the file in messages.
CsvTable ParseCsv(std::string_view text,
                  const std::string& name,
                  OddRows odd = OddRows::kRefuse);

/// Quotes a field for a comma-separated file where RFC 4180 asks for it.
std::string CsvField(std::string_view text);

/// Shortest text that reads back to the same double ("nan" becomes empty).
std::string CsvNumber(double value);

}  // namespace errmap::data
