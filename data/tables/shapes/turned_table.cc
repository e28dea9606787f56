#include "data/tables/shapes/turned_table.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "data/column_words.h"
#include "data/columns.h"
#include "data/tables/shapes/numbered_names.h"
#include "data/text.h"

namespace errmap::data {
namespace {

// Rows of numbers under names, some of which say that they are errors or runs.
bool NamesRows(const CsvTable& table) {
  constexpr std::size_t kFewestReadings = 4;
  const CsvColumn& names = table.columns.front();
  if (table.columns.size() <= kFewestReadings || table.num_rows < 2 ||
      !names.is_text() || names.texts.size() != table.num_rows) {
    return false;
  }
  const auto errors =
      std::ranges::count_if(names.texts, [](const std::string& text) {
        return ErrorSign(text) != 0 || ReadRunName(text).has_value();
      });
  return errors > 0 && errors < std::ssize(names.texts) &&
         std::all_of(table.columns.begin() + 1,
                     table.columns.end(),
                     [](const CsvColumn& column) {
                       return !column.is_text() && ErrorSign(column.name) == 0;
                     });
}

}  // namespace

void TurnTable(CsvTable* table) {
  if (!NamesRows(*table)) return;
  const CsvColumn& names = table->columns.front();
  const std::size_t readings = table->columns.size() - 1;
  CsvColumn heads{.name = names.name, .has_name = names.has_name};
  std::vector<double> numbers;
  for (std::size_t i = 1; i <= readings; ++i) {
    double number = 0.0;
    if (ParseNumber(table->columns[i].name, &number)) numbers.push_back(number);
  }
  if (numbers.size() == readings) {
    heads = NumberColumn(names.name, numbers);
  } else {
    std::vector<std::ptrdiff_t> codes;
    std::vector<std::string> words;
    for (std::size_t i = 0; i < readings; ++i) {
      codes.push_back(static_cast<std::ptrdiff_t>(i));
      words.push_back(table->columns[i + 1].name);
    }
    heads = WordColumn(names.name, codes, std::move(words));
  }
  std::vector<CsvColumn> columns{std::move(heads)};
  for (std::size_t row = 0; row < table->num_rows; ++row) {
    CsvColumn all{.name = *names.TextAt(row)};
    for (std::size_t i = 1; i <= readings; ++i) {
      AppendCells(
          TakeRows(table->columns[i], {static_cast<std::ptrdiff_t>(row)}),
          &all);
    }
    columns.push_back(std::move(all));
  }
  table->Remark(std::to_string(table->num_rows) +
                " rows of one variable each are read as columns");
  table->columns = std::move(columns);
  table->line_runs.clear();
  for (std::size_t row = 0; row < readings; ++row) {
    table->line_runs.emplace_back(row, 1);
  }
  table->num_rows = readings;
}

}  // namespace errmap::data
