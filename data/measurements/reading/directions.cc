#include "data/measurements/reading/directions.h"

#include <algorithm>

#include "data/column_words.h"
#include "data/columns.h"
#include "data/measurements/reading/axis.h"
#include "data/measurements/reading/derived_columns.h"
#include "data/measurements/reading/label_parts.h"
#include "data/measurements/row_filters.h"
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
    const std::vector<std::string> labels =
        LabelsOf(table, column, rows, 2).labels;
    // One word alone has to be one for a direction.
    const bool tells = labels.size() == 2
                           ? std::ranges::count(labels, "") == 0
                           : labels.size() == 1 && IsUpwards(labels[0]);
    if (tells) return static_cast<std::ptrdiff_t>(i);
  }
  return -1;
}

std::ptrdiff_t DirectionByValues(const CsvTable& table,
                                 std::size_t target,
                                 const std::vector<Index>& rows,
                                 const Motion& motion) {
  constexpr std::size_t kFewestPercent = 90;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (i == target) continue;
    const CsvColumn& column = table.columns[i];
    const auto [labels, codes] = LabelsOf(table, column, rows, 2);
    std::size_t agree = 0;
    for (std::size_t k = 0; k < codes.size(); ++k) {
      const bool goes_alike = motion.directions[k] == motion.directions[0];
      agree += (codes[k] == 0) == goes_alike ? 1 : 0;
    }
    if (labels.size() == 2 && std::ranges::count(labels, "") == 0 &&
        100 * agree >= kFewestPercent * rows.size()) {
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

CsvColumn DirectionColumn(const CsvTable& table,
                          const std::vector<Index>& rows,
                          const Motion& motion) {
  std::vector<Index> codes(table.num_rows, 2);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    codes[static_cast<std::size_t>(rows[i])] = motion.directions[i] > 0 ? 0 : 1;
  }
  return WordColumn(kDirectionColumn, codes, {"up", "down", ""});
}

void AddDerivedColumns(const std::vector<ColumnFilter>& filters,
                       const std::string& position,
                       const std::string& target,
                       const std::string& session,
                       CsvTable* table) {
  const std::vector<Index> rows = AllRows(table->num_rows);
  for (std::size_t i = 0; table->Find(session) < 0 && i < table->columns.size();
       ++i) {
    const CsvColumn& labels = table->columns[i];
    if (session != SessionsNamedIn(labels.name)) continue;
    auto sessions = FindSessionsInLabels(*table, labels, rows, 1);
    if (!sessions) break;
    table->columns.push_back(std::move(*sessions));
  }
  if (std::optional<DerivedTarget> derived =
          FindDerivedTarget(*table, target)) {
    table->columns.push_back(std::move(derived->column));
  }
  const bool needs_direction =
      std::ranges::any_of(filters, [&](const ColumnFilter& filter) {
        return filter.column == kDirectionColumn &&
               table->Find(kDirectionColumn) < 0;
      });
  if (!needs_direction) return;
  constexpr auto kNoTarget = static_cast<std::size_t>(-1);
  const Axis axis = FindAxis(*table, {.position = position}, kNoTarget, rows);
  if (axis.column < 0 || axis.motion.directions.empty()) return;
  table->columns.push_back(DirectionColumn(*table, rows, axis.motion));
}

}  // namespace errmap::data
