#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "cli/report/number_text.h"
#include "models/study/record/study_record.h"

// Tables of typed cells. Only the functions below write them, for terminals,
// spreadsheets, Markdown and pages.

namespace errmap::report {

/// A number with `digits` significant digits; shown as value * scale.
struct Number {
  double value;
  int digits = 4;
  double scale = 1.0;
};
/// A number with a fixed number of decimals.
struct Fixed {
  double value;
  int decimals;
};
/// An error in the target's unit. Shown with the table's ErrorText, or else
/// with four digits of value * scale.
struct Error {
  double value;
  double scale = 1.0;
};
/// A 95 % interval of an error, whose value is `of` if known.
struct Interval {
  models::IntervalRecord ends;
  double of = models::kNotKnown;
};
/// A probability with a remark.
struct P {
  double value;
  const char* remark = "";
};
/// A statistic and its p.
struct Statistic {
  double value;
  double p;
};
/// A word that has a shorter form for terminals, or another form in files.
struct Word {
  std::string text;
  std::string on_terminal;
  std::string in_csv;
};

/// Empty, a text, a whole number, or one of the above. An unknown value is NaN,
/// and is shown as an empty cell.
class Cell {
 public:
  using Value = std::variant<std::monostate,
                             std::string,
                             std::int64_t,
                             Number,
                             Fixed,
                             Error,
                             Interval,
                             P,
                             Statistic,
                             Word>;

  Cell() = default;
  Cell(const char* text) : value_(std::string(text)) {}       // NOLINT
  Cell(std::string_view text) : value_(std::string(text)) {}  // NOLINT
  template <typename T>
  Cell(std::optional<T> value) {  // NOLINT: cells are written as values
    if (value) value_ = Value(*std::move(value));
  }
  template <typename T>
  requires std::constructible_from<Value, T> Cell(T value)
      : value_(std::move(value)) {}  // NOLINT

  const Value& value() const { return value_; }

 private:
  Value value_;
};

struct Table {
  struct Column {
    std::string name;
    bool is_number = true;
    std::string explanation = {};  // on pages; "" if the name is enough
    /// On terminals: the text above the name, shared by columns of one `group`;
    /// the least width; the blanks before it.
    std::string above = {};
    std::string group = {};
    std::size_t width = 0;
    std::size_t gap = 2;
  };
  std::string title = {};
  std::string note = {};
  std::vector<Column> columns = {};
  std::vector<std::vector<Cell>> rows = {};
  std::size_t marked = std::string::npos;  // emphasised row
  /// Why there are no rows; shown instead of them.
  std::string missing = {};
  std::string nothing = "-";  // shown for an unknown value
  std::optional<ErrorText> error = {};

  /// A cell and the column that it is in.
  struct Named {
    Column column;
    Cell cell;
  };
  /// Adds a row; the first one sets the columns.
  void Add(std::vector<Named> row);
  void SayIfEmpty(std::string_view why) {
    if (rows.empty()) missing = why;
  }
  /// Returns a cell's text for display.
  std::string Shown(const Cell& cell) const;
};

/// Removes empty columns, except the first.
Table WithoutEmptyColumns(Table table);

/// Removes columns from the end until no line exceeds `width`, but keeps the
/// first `fewest`; returns the names of those removed.
std::vector<std::string> TakeColumns(std::size_t width,
                                     std::size_t fewest,
                                     Table* table);

/// Aligns columns, numbers to the right. Cuts words in the middle if a line
/// would exceed `width`. The order is: text above the names, if any, the names,
/// the rows.
std::vector<std::string> TerminalLines(const Table& table, std::size_t width);
std::string TerminalTable(const Table& table,
                          std::size_t width = std::string::npos);
/// Writes a header and one line for each row, with full precision.
std::string CsvTable(const Table& table);
/// `level` is the title's markup, "###". Omits empty columns, as HtmlTable
/// does.
std::string MarkdownTable(const Table& whole, const std::string& level = "");
/// Returns "" for a table that has only a reason for missing rows.
std::string HtmlTable(const Table& whole);

/// A way to write tables for other programs.
struct TableFormat {
  std::string_view name;  // the value of --format: "csv"
  std::string (*text)(const Table& table);
};
/// The formats offered wherever tables are written.
const std::vector<TableFormat>& TableFormats();
/// Returns nothing if no format has this name.
std::optional<std::string> TableText(const Table& table,
                                     std::string_view format);

}  // namespace errmap::report
