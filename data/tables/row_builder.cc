#include "data/tables/row_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/columns.h"

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

}  // namespace errmap::data
