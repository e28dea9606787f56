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

/// One column of the file. Numbers are parsed while reading; all other cells
/// are kept as text, once per distinct text.
struct CsvColumn {
  std::string name;
  bool has_name = true;      // false: `name` is not from the file
  ColumnValues values = {};  // (rows) quiet NaN where `exceptions` has the row
  /// Cells that are not finite numbers, ascending by row: (row, index in
  /// texts).
  std::vector<std::pair<std::size_t, std::uint32_t>> exceptions = {};
  std::vector<std::string> texts =
      {};  // distinct texts of those cells, trimmed
  /// First rows written with a decimal comma and with a decimal point, or -1.
  std::ptrdiff_t first_decimal_comma = -1;
  std::ptrdiff_t first_decimal_point = -1;

  /// True if no cell is a number: it can group rows, but is never an input.
  bool is_text() const { return exceptions.size() == values.size(); }
  /// Returns the text of a cell; null if it is a number.
  const std::string* TextAt(std::size_t row) const;
  /// Notes that a number in this row has a decimal comma or point.
  void NoteMarks(std::size_t row, bool comma, bool point) {
    const auto at = static_cast<std::ptrdiff_t>(row);
    if (comma && first_decimal_comma < 0) first_decimal_comma = at;
    if (point && first_decimal_point < 0) first_decimal_point = at;
  }
};

/// A CSV file, or several as one: named columns of equal length.
struct CsvTable {
  std::string file;  // as given; begins every message about it
  std::vector<CsvColumn> columns = {};
  std::size_t num_rows = 0;

  /// Returns the index of the column of that name, or -1.
  std::ptrdiff_t Find(std::string_view name) const;
  /// Returns the column of an index of at least 0, such as Find's.
  template <typename Index>
  const CsvColumn& At(Index index) const {
    return columns[static_cast<std::size_t>(index)];
  }
  /// 1-based line of the file on which data row `row` (0-based) starts.
  std::size_t LineOfRow(std::size_t row) const;
  /// Returns "xdown.csv: line 18 (data row 16), column 't3_degC'", the
  /// beginning of a message. A table in memory has no lines.
  std::string Where(std::size_t row, std::string_view column) const;
  /// Text of a cell: its text if it is not a number, else the number in its
  /// shortest form.
  std::string CellText(const CsvColumn& column, std::size_t row) const;
  /// Adds a remark, after the name of the file.
  void Remark(const std::string& what);

  /// Series of rows on successive lines: (first row, its line), ascending; rows
  /// after comments, quoted line breaks or the header start a new series.
  std::vector<std::pair<std::size_t, std::size_t>> line_runs = {};
  /// Of several files: (first row, file as given), ascending; else empty.
  std::vector<std::pair<std::size_t, std::string>> parts = {};

  /// Lines of words and comments above and below the table: a program's name, a
  /// date, the axis.
  std::vector<std::string> titles = {};
  /// Remarks for the user, one line each, on what is unusual in the file and
  /// how it was read.
  std::vector<std::string> remarks = {};
};

/// How to treat rows whose number of cells differs from that of the others.
/// kRefuse throws and names all of them in one message. kOffer also names the
/// option that leaves them out (MissingPolicy). kLeaveOut leaves them out with
/// a remark.
enum class OddRows { kRefuse, kOffer, kLeaveOut };

/// Reads a CSV file. Its rows show what separates cells: `,` `;` `|`, tabs or
/// blanks. Quotes follow RFC 4180, but quotes inside a cell need not be
/// doubled. Commas are decimal marks if they do not separate cells. Lines
/// starting with `#`, blank lines at the end and a byte order mark are skipped.
/// Text that is not UTF-8 is converted from Windows 1252 or, with a remark,
/// from the encoding that gives more known words (tables/text/text_encoding.h).
/// A gzip file is unpacked first, up to kMostTextOfPrograms and MostUnpacked.
/// One sheet of an xlsx file is read ("book.xlsx:Day 2",
/// tables/text/spreadsheet.h). Linear time, about twice the file's memory;
/// independent of the locale.
///
/// Read with a remark:
/// - lines above the table (`titles`), blank lines, names repeated between rows
/// - no names (column_1, ...), names in a comment, in two rows, above channels
///   or used twice (x, x_2), and columns that no row reaches
/// - lines of words between rows: a column if they separate days or runs; a
///   last line cut off in mid number: left out
/// - a column for each position ("e@-215.9mm_um", "X=25 mm"), run ("Run 1 up
///   [um]") or direction ("Error up [um]"): a row for each reading. Rows of one
///   reading or one variable each become such rows, too
/// - numbers as people write them (tables/cells/loose_numbers.h), points
///   between thousands, single quotes, and columns aligned by blanks
///   (tables/text/rewritten_text.h)
/// An unnamed column is called column_N (`has_name` is false).
///
/// Throws InputError for an unreadable or empty file, a header alone, a number
/// in place of a name, and rows of another length (OddRows). Also for a second
/// table below, a blank line in a single column, an open quote, a NUL byte, or
/// more than 65536 columns. MakeDataset checks cells that are not numbers.
CsvTable ReadCsv(const std::string& path, OddRows odd = OddRows::kRefuse);

/// Reads a CSV file and its Sha256OfFile in one pass.
CsvTable ReadCsv(const std::string& path,
                 std::string* sha256,
                 OddRows odd = OddRows::kRefuse);

/// Reads CSV text in memory. `name` stands for the file in messages.
CsvTable ParseCsv(std::string_view text,
                  const std::string& name,
                  OddRows odd = OddRows::kRefuse);

/// Quotes a field for a comma-separated file if RFC 4180 requires it.
std::string CsvField(std::string_view text);

/// Shortest text that reads back to the same double ("nan" becomes empty).
std::string CsvNumber(double value);

}  // namespace errmap::data
