#include "data/tables/row_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "data/columns.h"
#include "data/tables/cells/missing_cells.h"
#include "data/tables/cells/unit_cells.h"
#include "data/text.h"

namespace errmap::data {

void RowBuilder::AddNumber(std::size_t column,
                           std::string_view text,
                           const NumberForm& form) {
  ColumnShape& shape = shapes_[column];
  if (!form.decimal_comma && !form.decimal_point) {
    shape.most_whole = std::max(shape.most_whole, std::abs(form.value));
    table_.columns[column].values.push_back(form.value);
    return;
  }
  const std::size_t mark = text.find(form.decimal_comma ? ',' : '.');
  const bool may_part = MayPartThousands(text, mark);
  if (shape.by_thousands && may_part) {
    table_.columns[column].values.push_back(std::round(1000.0 * form.value));
    return;
  }
  shape.any_parted = true;
  shape.all_threes = shape.all_threes && may_part;
  shape.most_parted = std::max(shape.most_parted, std::abs(form.value));
  shape.least_parted = std::min(shape.least_parted, std::abs(form.value));
  CsvColumn& cells = table_.columns[column];
  cells.NoteMarks(table_.num_rows, form.decimal_comma, !form.decimal_comma);
  cells.values.push_back(form.value);
}

void RowBuilder::AddValue(std::size_t column,
                          std::string_view text,
                          const NumberForm& form) {
  CsvColumn& cells = table_.columns[column];
  const bool is_plain = text.find_first_not_of("+-0123456789.,") == text.npos;
  for (const char mark : {'.', ','}) {
    if (is_plain && std::ranges::count(text, mark) > 1) {
      shapes_[column].groups_mark = mark;
    }
  }
  cells.NoteMarks(table_.num_rows, form.decimal_comma, form.decimal_point);
  cells.values.push_back(form.value);
}

void RowBuilder::AddText(std::size_t column, std::string_view text) {
  CsvColumn& cells = table_.columns[column];
  cells.exceptions.emplace_back(table_.num_rows,
                                texts_[column].IndexOf(text, &cells.texts));
  cells.values.push_back(std::numeric_limits<double>::quiet_NaN());
}

void RowBuilder::End(std::size_t line) {
  auto& runs = table_.line_runs;
  if (runs.empty() ||
      runs.back().second + (table_.num_rows - runs.back().first) != line) {
    runs.emplace_back(table_.num_rows, line);
  }
  ++table_.num_rows;
}

void RowBuilder::Undo(std::size_t cells) {
  any_undone_ = true;
  for (std::size_t i = 0; i < std::min(cells, table_.columns.size()); ++i) {
    CsvColumn& column = table_.columns[i];
    column.values.Own().resize(table_.num_rows);
    if (!column.exceptions.empty() &&
        column.exceptions.back().first == table_.num_rows) {
      column.exceptions.pop_back();
    }
    const auto row = static_cast<std::ptrdiff_t>(table_.num_rows);
    for (std::ptrdiff_t* const first :
         {&column.first_decimal_comma, &column.first_decimal_point}) {
      if (*first == row) *first = -1;
    }
  }
}

bool RowBuilder::PartThousands() {
  if (!data::PartThousands(&shapes_, &table_)) return false;
  for (CsvColumn& column : table_.columns) {
    column.values = {};
    column.exceptions.clear();
    column.texts.clear();
    column.first_decimal_comma = column.first_decimal_point = -1;
  }
  texts_.assign(table_.columns.size(), {});
  table_.line_runs.clear();
  table_.num_rows = 0;
  return true;
}

void RowBuilder::DropTextsOfUndone() {
  if (!any_undone_) return;
  for (CsvColumn& column : table_.columns) DropUnusedTexts(&column);
}

namespace {

const std::string& TextIn(const CsvTable& table, std::size_t index) {
  const CsvColumn& column = table.columns[index];
  return column.texts[column.exceptions.back().second];
}

// Whether most cells above the last row are numbers.
bool HoldsNumbers(const CsvTable& table, const CsvColumn& column) {
  return 2 * (column.exceptions.size() - 1) < table.num_rows;
}

}  // namespace

bool IsRemark(const CsvTable& table) {
  const std::string& text = TextIn(table, 0);
  return text.size() > 2 && !HasDigit(text.substr(0, 1)) &&
         !IsMissingNumber(text) && text.find(' ') != text.npos;
}

bool IsEmptyRow(const CsvTable& table, std::size_t cells) {
  for (std::size_t i = 0; i < cells; ++i) {
    if (!TextIn(table, i).empty()) return false;
  }
  return true;
}

bool HoldsRemarkAlone(const CsvTable& table, std::size_t cells) {
  const CsvColumn& first = table.columns[0];
  if (table.num_rows > 0 && !HoldsNumbers(table, first)) return false;
  for (std::size_t i = 1; i < cells; ++i) {
    if (!TextIn(table, i).empty()) return false;
  }
  return true;
}

bool AreTotals(const CsvTable& table) {
  constexpr std::size_t kFewestOfRow = 4;
  const CsvColumn& first = table.columns[0];
  if (table.columns.size() < kFewestOfRow || table.num_rows == 0 ||
      first.exceptions.empty() ||
      first.exceptions.back().first != table.num_rows ||
      !HoldsNumbers(table, first)) {
    return false;
  }
  const std::string& text = TextIn(table, 0);
  return !IsMissingNumber(text) && text.find_first_of("0123456789+-.") != 0;
}

bool RepeatsNames(const CsvTable& table, std::span<const std::string> names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (TextIn(table, i) != names[i]) return false;
  }
  return table.num_rows > 0 && !names.empty();
}

bool HasUnits(const CsvTable& table, std::size_t width) {
  std::vector<std::string> cells;
  for (std::size_t i = 0; i < width; ++i) cells.push_back(TextIn(table, i));
  return AreUnitCells(std::move(cells));
}

bool HasWordsForNumbers(const CsvTable& table, std::size_t cells) {
  std::size_t num_numeric = 0;
  std::size_t num_words = 0;
  for (std::size_t i = 0; i < cells; ++i) {
    if (!HoldsNumbers(table, table.columns[i])) continue;
    ++num_numeric;
    num_words += IsMissingNumber(TextIn(table, i)) ? 0 : 1;
  }
  return num_numeric > 1 && 2 * num_words >= num_numeric;
}

}  // namespace errmap::data
