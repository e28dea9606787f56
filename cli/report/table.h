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

// Tables of typed cells, which are written for terminals, spreadsheets,
// Markdown and pages by the functions below and nowhere else.

namespace errmap::report {

/// A number with so many significant digits; shown as value * scale.
struct Number {
  double value;
  int digits = 4;
  double scale = 1.0;
};
/// A number with so many decimals.
struct Fixed {
  double value;
  int decimals;
};
/// An error in the target's unit; shown with the table's ErrorText, or else
/// with four digits of value * scale.
struct Error {
  double value;
  double scale = 1.0;
};
/// A 95 % interval of an error, of `of` if that is known.
struct Interval {
  models::IntervalRecord ends;
  double of = models::kNotKnown;
};
/// A probability, with a remark on it.
struct P {
  double value;
  const char* remark = "";
};
/// A statistic and its p.
struct Statistic {
  double value;
  double p;
};
/// A word that terminals have no room for, or that files have in another form.
struct Word {
  std::string text;
  std::string on_terminal;
  std::string in_csv;
};

/// Nothing, a text, a whole number, or one of the above. What is not known is
/// NaN, and stands in the table as nothing does.
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
    std::string explanation = {};  // of pages; "" where the name says it all
    /// On terminals: what stands over the name, columns of one `group` having
    /// it in common; least width; blanks before it.
    std::string above = {};
    std::string group = {};
    std::size_t width = 0;
    std::size_t gap = 2;
  };
  std::string title = {};
  std::string note = {};
  std::vector<Column> columns = {};
  std::vector<std::vector<Cell>> rows = {};
  std::size_t marked = std::string::npos;  // row that stands out
  /// Why there are no rows; shown in their place.
  std::string missing = {};
  std::string nothing = "-";  // stands where nothing is known
  std::optional<ErrorText> error = {};

  /// A cell as people read it.
  std::string Shown(const Cell& cell) const;
};

/// Aligned in columns, numbers to the right; words are cut in the middle where
/// a line would be longer than `width`. First what stands above the names, if
/// anything, then the names, then the rows.
std::vector<std::string> TerminalLines(const Table& table, std::size_t width);
std::string TerminalTable(const Table& table,
                          std::size_t width = std::string::npos);
/// A header and a line per row, values in full.
std::string CsvTable(const Table& table);
/// `level`: what marks the title, "###". Like HtmlTable without columns that
/// are empty.
std::string MarkdownTable(const Table& whole, const std::string& level = "");
/// "" for a table that says only what it misses.
std::string HtmlTable(const Table& whole);

/// A way to write tables for other programs.
struct TableFormat {
  std::string_view name;  // as --format has it: "csv"
  std::string (*text)(const Table& table);
};
/// Whatever offers such formats offers these.
const std::vector<TableFormat>& TableFormats();
/// Nothing where no format has this name.
std::optional<std::string> TableText(const Table& table,
                                     std::string_view format);

}  // namespace errmap::report
