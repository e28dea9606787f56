#include "data/measurements/reading/directions.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "data/measurements/reading/axis.h"
#include "data/measurements/reading/column_words.h"
#include "data/measurements/reading/derived_columns.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {

using Eigen::Index;

std::ptrdiff_t NamedDirection(const CsvTable& table,
                              const DatasetSelection& selection,
                              const std::vector<Index>& rows) {
  const std::ptrdiff_t named = table.Find(selection.direction);
  if (named >= 0) return named;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const CsvColumn& column = table.columns[i];
    if (column.name == selection.target || column.name == selection.weight ||
        !Says(column.name, Word::kDirection) ||
        !UnitOfColumn(column.name).symbol.empty()) {
      continue;
    }
    std::set<std::string> values;
    for (const Index row : rows) {
      values.insert(table.CellText(column, static_cast<std::size_t>(row)));
      if (values.size() > 2) break;
    }
    if (values.size() == 2 && !values.contains("")) {
      return static_cast<std::ptrdiff_t>(i);
    }
  }
  return -1;
}

std::vector<ColumnFilter> DirectionsOf(const Reading& reading,
                                       const DatasetSelection& selection) {
  std::vector<ColumnFilter> filters;
  if (IsUpwards(selection.direction)) return filters;
  if (!reading.direction.column || reading.direction.values.size() != 2) {
    return filters;
  }
  for (const ColumnFilter& filter : selection.where) {
    if (filter.column == *reading.direction.column) return filters;
  }
  for (const std::string& label : reading.direction.labels) {
    filters.push_back({.column = *reading.direction.column, .value = label});
  }
  return filters;
}

void AddDerivedColumns(const std::vector<ColumnFilter>& filters,
                       const std::string& position,
                       const std::string& target,
                       CsvTable* table) {
  if (target.starts_with('-') && table->Find(target) < 0) {
    const std::ptrdiff_t of = table->Find(target.substr(1));
    if (of >= 0) table->columns.push_back(Negative(table->At(of)));
  }
  const bool needs_direction =
      std::ranges::any_of(filters, [&](const ColumnFilter& filter) {
        return filter.column == kDirectionColumn &&
               table->Find(kDirectionColumn) < 0;
      });
  if (!needs_direction) return;
  std::vector<Index> rows(table->num_rows);
  std::iota(rows.begin(), rows.end(), Index{0});
  constexpr auto kNoTarget = static_cast<std::size_t>(-1);
  const Axis axis = FindAxis(*table, {.position = position}, kNoTarget, rows);
  if (axis.column < 0 || axis.motion.directions.empty()) return;
  std::vector<int> codes;
  for (const int way : axis.motion.directions) codes.push_back(way > 0 ? 0 : 1);
  table->columns.push_back(WordColumn(kDirectionColumn, codes, {"up", "down"}));
}

}  // namespace errmap::data
