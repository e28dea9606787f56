#include "data/measurements/reading/derived_columns.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

namespace errmap::data {

using Eigen::Index;

CsvTable Borrowed(const CsvTable& table) {
  CsvTable borrowed = {.file = table.file,
                       .columns = {},
                       .num_rows = table.num_rows,
                       .line_runs = table.line_runs,
                       .parts = table.parts,
                       .titles = table.titles,
                       .remarks = table.remarks};
  const std::shared_ptr<const void> keeper(&table, [](const void*) {});
  for (const CsvColumn& column : table.columns) {
    CsvColumn& copy = borrowed.columns.emplace_back(
        CsvColumn{.name = column.name,
                  .has_name = column.has_name,
                  .values = {},
                  .exceptions = column.exceptions,
                  .texts = column.texts,
                  .first_decimal_comma = column.first_decimal_comma,
                  .first_decimal_point = column.first_decimal_point});
    if (column.values.empty()) continue;
    const double* first = &column.values[0];
    const std::ptrdiff_t stride =
        column.values.size() > 1 ? &column.values[1] - first : 1;
    copy.values =
        ColumnValues::Borrowed(first, stride, column.values.size(), keeper);
  }
  return borrowed;
}

CsvTable InOrder(const CsvTable& table, const std::vector<Index>& order) {
  CsvTable sorted = {.file = table.file,
                     .columns = {},
                     .num_rows = table.num_rows,
                     .line_runs = {},
                     .parts = {},
                     .titles = table.titles,
                     .remarks = table.remarks};
  std::vector<Index> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[static_cast<std::size_t>(order[i])] = static_cast<Index>(i);
  }
  for (const CsvColumn& column : table.columns) {
    CsvColumn copy = {.name = column.name,
                      .has_name = column.has_name,
                      .values = {},
                      .exceptions = column.exceptions,
                      .texts = column.texts,
                      .first_decimal_comma = -1,
                      .first_decimal_point = -1};
    std::vector<double>& values = copy.values.Own();
    values.reserve(order.size());
    for (const Index row : order) {
      values.push_back(column.values[static_cast<std::size_t>(row)]);
    }
    for (auto& [row, text] : copy.exceptions) {
      row = static_cast<std::size_t>(place[row]);
    }
    std::ranges::sort(copy.exceptions);
    const auto moved = [&](std::ptrdiff_t row) {
      return row < 0 ? row : place[static_cast<std::size_t>(row)];
    };
    copy.first_decimal_comma = moved(column.first_decimal_comma);
    copy.first_decimal_point = moved(column.first_decimal_point);
    sorted.columns.push_back(std::move(copy));
  }
  for (std::size_t i = 0; !table.line_runs.empty() && i < order.size(); ++i) {
    sorted.line_runs.emplace_back(
        i, table.LineOfRow(static_cast<std::size_t>(order[i])));
  }
  return sorted;
}

CsvColumn NumberColumn(const std::string& name, std::vector<double> values) {
  CsvColumn column{.name = name, .values = {}, .exceptions = {}, .texts = {}};
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!std::isnan(values[row])) continue;
    if (column.texts.empty()) column.texts.emplace_back();
    column.exceptions.emplace_back(row, 0U);
  }
  column.values = std::move(values);
  return column;
}

CsvColumn WordColumn(const std::string& name,
                     const std::vector<int>& codes,
                     std::vector<std::string> words) {
  CsvColumn column{
      .name = name, .values = {}, .exceptions = {}, .texts = std::move(words)};
  column.values = std::vector<double>(codes.size(), std::nan(""));
  for (std::size_t row = 0; row < codes.size(); ++row) {
    column.exceptions.emplace_back(row, static_cast<std::uint32_t>(codes[row]));
  }
  return column;
}

CsvColumn Negative(const CsvColumn& column) {
  CsvColumn negative = column;
  negative.name = "-" + column.name;
  std::vector<double> values(column.values.begin(), column.values.end());
  for (double& value : values) value = -value;
  negative.values = std::move(values);
  return negative;
}

}  // namespace errmap::data
