#include "data/measurements/column_checks.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>

#include "data/argument_name.h"
#include "data/column_header.h"
#include "data/columns.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {
namespace {

constexpr std::size_t kMostNames = 20;  // in one message

bool IsInfinity(std::string_view text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  return EqualsIgnoringCase(text, "inf") ||
         EqualsIgnoringCase(text, "infinity");
}

bool IsOutOfRange(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const char* const end = text.data() + text.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc::result_out_of_range && stop == end;
}

bool HasDecimalComma(std::string_view text) {
  std::string with_point(text);
  std::replace(with_point.begin(), with_point.end(), ',', '.');
  double value = 0.0;
  return with_point != text && ParseNumber(with_point, &value);
}

// A word that no list has ("No Signal", "****") is not a reading all the same,
// nor is the limit of an instrument ("<0.05").
bool HasNoDigit(std::string_view text) {
  return (!HasDigit(text) || text.starts_with('<') || text.starts_with('>')) &&
         !IsInfinity(text);
}

// Whether a word is a unit where it is sure to mean one.
bool IsUnit(std::string_view word) {
  return ReadHeader("x [" + std::string(word) + "]").source ==
         UnitSource::kStated;
}

// "12.7 mm", "1.234,5", "1 234": a number with its unit, or with separators
// that only people read.
bool IsNumberForPeople(std::string_view text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  if (text.empty() || text.front() < '0' || text.front() > '9') return false;
  const std::string_view rest = text.substr(
      std::min(text.find_first_not_of("0123456789.,' "), text.size()));
  return rest.empty() || IsUnit(rest);
}

// What is wrong with a cell that is not a finite number, and how to mend it.
std::string Complaint(std::string_view text) {
  if (text.empty()) return "empty cell; fill it in";
  const std::string quoted = QuotedText(text);
  if (IsMissingNumber(text)) return quoted + " is a missing value; fill it in";
  if (IsInfinity(text)) return quoted + " is not finite; correct it";
  if (HasNoDigit(text)) return quoted + " is not a number; fill it in";
  if (IsOutOfRange(text)) {
    return quoted + " is beyond the range of a double; correct it";
  }
  if (HasDecimalComma(text)) {
    return quoted +
           " is not a number here; write a decimal point, or separate the "
           "columns with ; or tab";
  }
  if (IsNumberForPeople(text)) {
    return quoted +
           " is not a plain number; write it without its unit and without "
           "thousands separators";
  }
  return quoted + " is not a number; correct it";
}

// A cell of a column in use that is not a finite number.
struct BadCell {
  std::size_t row;
  const CsvColumn* column;
  ColumnUse use;
  const std::string* text;
};

[[noreturn]] void ThrowBadCell(const CsvTable& table,
                               const BadCell& cell,
                               std::size_t num_missing) {
  const std::string& text = *cell.text;
  std::string what =
      table.Where(cell.row, cell.column->name) + ": " + Complaint(text);
  // A row with an empty cell may be shifted, and its other cells wrong.
  const bool lacks_most =
      2 * cell.column->exceptions.size() > cell.column->values.size();
  if (cell.use == ColumnUse::kInput && (lacks_most || !text.empty())) {
    what +=
        ", or leave the column out with " +
        ArgumentName("exclude", Printable(cell.column->name, text.max_size()));
  }
  if (IsMissingNumber(text) || HasNoDigit(text) || IsInfinity(text)) {
    what += ", or drop such rows with " + ArgumentName("missing", "drop-rows");
    if (num_missing > 1) {
      what += " (the columns in use have " + std::to_string(num_missing) +
              " such cells)";
    }
  }
  throw InputError(what);
}

[[noreturn]] void ThrowNothingPasses(const CsvTable& table,
                                     const CsvColumn& column,
                                     const std::vector<ColumnFilter>& filters,
                                     const ColumnFilter& filter) {
  std::vector<std::string> values =
      LabelsOf(table, column, AllRows(table.num_rows), kMostNames - 1).labels;
  throw InputError(PrintablePath(table.file) + ": no row is left where " +
                   QuotedName(filter.column) + " is " +
                   QuotedText(ValueText(filter)) +
                   (&filter == &filters.front()
                        ? ""
                        : " and the columns before it are as asked") +
                   "; the column has " + ListOfNames(values));
}

// Cells of columns in use that hold no finite number, in rows that pass.
struct BadCells {
  std::optional<BadCell> first_missing;
  std::optional<BadCell> first_wrong;
  std::size_t num_missing = 0;
  std::vector<bool> is_dropped;         // by row: with a missing cell
  const CsvColumn* emptiest = nullptr;  // null: nothing is missing
  std::size_t most_missing = 0;         // in that column
};

BadCells FindBadCells(const CsvTable& table,
                      const std::vector<ColumnInUse>& columns,
                      const std::vector<bool>& passes,
                      MissingPolicy missing) {
  const bool drops = missing == MissingPolicy::kDropRows;
  BadCells bad;
  bad.is_dropped.assign(table.num_rows, false);
  for (const ColumnInUse& used : columns) {
    const CsvColumn& column = table.columns[used.index];
    std::vector<bool> text_is_missing(column.texts.size());
    for (std::size_t i = 0; i < column.texts.size(); ++i) {
      const std::string& text = column.texts[i];
      text_is_missing[i] = used.use == ColumnUse::kGroup
                               ? IsMissingText(text)
                               : IsMissingNumber(text) || HasNoDigit(text) ||
                                     (drops && IsInfinity(text));
    }
    std::size_t missing_here = 0;
    for (const auto& [row, text] : column.exceptions) {
      if (!passes[row]) continue;
      const bool is_missing = text_is_missing[text];
      if (!is_missing && used.use == ColumnUse::kGroup) continue;
      std::optional<BadCell>& first =
          is_missing ? bad.first_missing : bad.first_wrong;
      if (!first.has_value() || row < first->row) {
        first = BadCell{row, &column, used.use, &column.texts[text]};
      }
      if (is_missing) {
        ++missing_here;
        bad.is_dropped[row] = true;
      }
    }
    bad.num_missing += missing_here;
    if (missing_here > bad.most_missing) {
      bad.most_missing = missing_here;
      bad.emptiest = &column;
    }
  }
  return bad;
}

}  // namespace

void ThrowUnusable(const CsvTable& table, const std::string& what) {
  throw InputError(PrintablePath(table.file) + ": " + what);
}

std::string NameInRemark(const std::string& name) {
  return Printable(name, name.max_size());
}

std::string ListOfNames(const std::vector<std::string>& names) {
  std::vector<std::string> quoted;
  for (const std::string& name : names) quoted.push_back(QuotedName(name));
  return ShortList(quoted, kMostNames);
}

std::string NearestColumn(std::string_view name,
                          const std::vector<std::string>& known) {
  std::string nearest = NearestName(name, known);
  if (!nearest.empty()) return nearest;
  std::vector<std::string> without_unit;
  for (const std::string& column : known) {
    without_unit.push_back(ReadHeader(column).base);
  }
  // The typed name may end in an unknown unit, such as t1_C.
  const std::string typed = ReadHeader(name).base;
  std::string base = NearestName(typed, without_unit);
  if (base.empty()) {
    base = NearestName(typed.substr(0, typed.rfind('_')), without_unit);
  }
  const auto found = std::ranges::find(without_unit, base);
  return base.empty() || found == without_unit.end()
             ? ""
             : known[found - without_unit.begin()];
}

std::size_t RequireColumn(const CsvTable& table,
                          std::string_view name,
                          std::string_view argument) {
  const std::ptrdiff_t found = table.Find(name);
  if (found >= 0) return static_cast<std::size_t>(found);
  std::vector<std::string> known;
  for (const CsvColumn& column : table.columns) known.push_back(column.name);
  const std::string nearest = NearestColumn(name, known);
  throw InputError(
      PrintablePath(table.file) + ": no column " + QuotedName(name) + " (" +
      std::string(argument) + "); " +
      (nearest.empty() ? "" : "did you mean " + QuotedName(nearest) + "? ") +
      "the columns are " + ListOfNames(known));
}

void RequireNumbers(const CsvTable& table, const ColumnInUse& column) {
  const CsvColumn& cells = table.columns[column.index];
  if (!cells.is_text()) return;
  std::string what =
      PrintablePath(table.file) + ": column " + QuotedName(cells.name);
  if (cells.texts.empty()) {
    what += " holds no numbers";
  } else {
    what += " holds no numbers (data row 0 is " +
            QuotedText(table.CellText(cells, 0)) + ")";
  }
  if (column.use == ColumnUse::kTarget) {
    what += "; name a column of measured errors with " + ArgumentName("target");
  } else if (column.use == ColumnUse::kInput) {
    what +=
        " and cannot be an input; leave it out of " + ArgumentName("inputs");
  } else if (column.use == ColumnUse::kWeight) {
    what +=
        "; name a column of positive numbers with " + ArgumentName("weight");
  } else {
    what += "; name a column of numbers";
  }
  throw InputError(what);
}

std::string WhyNoUnit(const Header& header) {
  if (header.source == UnitSource::kDoubtful) {
    return QuotedText(header.unit_text) + " can be read in several ways";
  }
  return QuotedText(header.unit_text) +
         (IsUnit(header.unit_text)
              ? " counts as a unit in brackets or parentheses only"
              : " is not a unit known here");
}

void RequireKnownUnit(const CsvTable& table, const ColumnInUse& column) {
  const std::string& name = table.columns[column.index].name;
  const Header header = ReadHeader(name);
  const bool is_refused = header.source == UnitSource::kUnknown ||
                          ((header.source == UnitSource::kUnread ||
                            header.source == UnitSource::kDoubtful) &&
                           column.use == ColumnUse::kTarget);
  if (!is_refused) return;
  ThrowUnusable(
      table,
      "column " + QuotedName(name) + ": " + WhyNoUnit(header) +
          (header.source == UnitSource::kDoubtful
               ? "; rename the column, its unit in brackets at the end: "
                 "'error [um]', 'error [mm]'"
           : column.use == ColumnUse::kTarget
               ? "; add one to the name: " +
                     ArgumentName(
                         "target",
                         name + " [" +
                             (IsUnit(header.unit_text) ? header.unit_text
                                                       : std::string("um")) +
                             "]") +
                     " (or mm, in, arcsec, urad, deg)"
               : "; rename the column, with one of these in brackets: " +
                     KnownUnits()));
}

void RefuseNumbersAsText(const CsvTable& table, const CsvColumn& column) {
  if (!column.is_text()) return;
  bool any = false;
  bool all_numbers = true;
  for (const std::string& text : column.texts) {
    if (IsMissingNumber(text)) continue;
    any = true;
    all_numbers = all_numbers && IsNumberForPeople(text);
  }
  if (!NamesPosition(column.name) && !(any && all_numbers)) return;
  std::size_t row = 0;
  while (any && row + 1 < table.num_rows &&
         IsMissingNumber(table.CellText(column, row))) {
    ++row;
  }
  throw InputError(table.Where(row, column.name) + ": " +
                   Complaint(table.CellText(column, row)) +
                   " (no cell of the column is a plain number), or exclude "
                   "the column");
}

void RefuseMixedDecimals(const CsvTable& table,
                         const std::vector<ColumnInUse>& columns) {
  const CsvColumn* with_comma = nullptr;
  const CsvColumn* with_point = nullptr;
  for (const ColumnInUse& used : columns) {
    if (used.use == ColumnUse::kGroup) continue;
    const CsvColumn& column = table.columns[used.index];
    if (with_comma == nullptr && column.first_decimal_comma >= 0) {
      with_comma = &column;
    }
    if (with_point == nullptr && column.first_decimal_point >= 0) {
      with_point = &column;
    }
  }
  if (with_comma == nullptr || with_point == nullptr) return;
  const auto comma_row =
      static_cast<std::size_t>(with_comma->first_decimal_comma);
  const auto point_row =
      static_cast<std::size_t>(with_point->first_decimal_point);
  std::string comma_text = CsvNumber(with_comma->values[comma_row]);
  std::replace(comma_text.begin(), comma_text.end(), '.', ',');
  throw InputError(
      table.Where(point_row, with_point->name) + ": decimal point (" +
      CsvNumber(with_point->values[point_row]) + "), but decimal comma (" +
      comma_text + ") at line " + std::to_string(table.LineOfRow(comma_row)) +
      " (data row " + std::to_string(comma_row) + "), column " +
      QuotedName(with_comma->name) +
      "; write all numbers one way, without thousands separators");
}

bool KeepPassing(const CsvTable& table,
                 const ColumnFilter& filter,
                 std::vector<bool>* passes) {
  const CsvColumn& column = table.At(table.Find(filter.column));
  const auto* const number = std::get_if<double>(&filter.value);
  bool any = false;
  for (std::size_t row = 0; row < table.num_rows; ++row) {
    if (!(*passes)[row]) continue;
    (*passes)[row] = number != nullptr
                         ? column.values[row] == *number
                         : table.CellText(column, row) ==
                               std::get<std::string>(filter.value);
    any = any || (*passes)[row];
  }
  return any;
}

std::vector<bool> RowsThatPass(const CsvTable& table,
                               const std::vector<ColumnFilter>& filters) {
  std::vector<bool> passes(table.num_rows, true);
  for (const ColumnFilter& filter : filters) {
    const std::size_t column = RequireColumn(table, filter.column, "where");
    if (!KeepPassing(table, filter, &passes)) {
      ThrowNothingPasses(table, table.columns[column], filters, filter);
    }
  }
  return passes;
}

KeptRows CheckCells(const CsvTable& table,
                    const std::vector<ColumnInUse>& columns,
                    const std::vector<bool>& passes,
                    MissingPolicy missing) {
  const BadCells bad = FindBadCells(table, columns, passes, missing);
  const bool missing_comes_first =
      bad.first_missing.has_value() &&
      (!bad.first_wrong.has_value() ||
       bad.first_missing->row < bad.first_wrong->row);
  if (missing == MissingPolicy::kError && missing_comes_first) {
    ThrowBadCell(table, *bad.first_missing, bad.num_missing);
  }
  if (bad.first_wrong.has_value()) {
    ThrowBadCell(table, *bad.first_wrong, bad.num_missing);
  }
  KeptRows kept;
  kept.num_passed =
      static_cast<std::size_t>(std::count(passes.begin(), passes.end(), true));
  kept.rows.reserve(kept.num_passed);
  for (std::size_t row = 0; row < table.num_rows; ++row) {
    if (passes[row] && !bad.is_dropped[row]) {
      kept.rows.push_back(static_cast<Eigen::Index>(row));
    }
  }
  if (kept.rows.empty()) {
    throw InputError(PrintablePath(table.file) +
                     ": no row is left: each has a missing cell in the "
                     "columns in use (" +
                     QuotedName(bad.emptiest->name) + " lacks " +
                     std::to_string(bad.most_missing) + " of " +
                     std::to_string(kept.num_passed) +
                     "); fill them in, or leave such columns out with " +
                     ArgumentName("exclude"));
  }
  if (kept.rows.size() < kept.num_passed) {
    kept.first_missing =
        table.Where(bad.first_missing->row, bad.first_missing->column->name);
  }
  return kept;
}

void RefuseMissingCell(const CsvTable& table,
                       const ColumnInUse& column,
                       std::size_t row) {
  const CsvColumn& cells = table.columns[column.index];
  const std::string* const text = cells.TextAt(row);
  if (text == nullptr) return;
  const bool is_missing = column.use == ColumnUse::kGroup
                              ? IsMissingText(*text)
                              : IsMissingNumber(*text);
  if (is_missing) ThrowBadCell(table, {row, &cells, column.use, text}, 1);
}

Eigen::VectorXd ValuesOfRows(const CsvColumn& column,
                             const std::vector<Eigen::Index>& rows) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    values(static_cast<Eigen::Index>(i)) = column.values[rows[i]];
  }
  return values;
}

}  // namespace errmap::data
