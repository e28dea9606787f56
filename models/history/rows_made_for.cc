#include "models/history/rows_made_for.h"

#include "data/measurements/axis/directions.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/row_filters.h"

namespace errmap::models {

std::optional<std::string> WayOf(const FittedModel& fitted) {
  if (fitted.reading == nullptr || !fitted.reading->direction.sure) {
    return std::nullopt;
  }
  const data::Reading::Direction& direction = fitted.reading->direction;
  const data::ColumnFilter* const filter = data::DirectionFilter(fitted.where);
  if (filter == nullptr) {
    return direction.values.size() == 1 ? std::optional(direction.values[0])
                                        : std::nullopt;
  }
  const auto place = data::PlaceOfWay(direction, ValueText(*filter));
  return place ? std::optional(direction.values[*place]) : std::nullopt;
}

std::vector<data::ColumnFilter> FiltersFor(const FittedModel& fitted,
                                           const data::CsvTable& table) {
  const std::optional<std::string> way =
      table.Find(kWayColumn) < 0 ? std::nullopt : WayOf(fitted);
  std::vector<data::ColumnFilter> filters;
  for (const data::ColumnFilter& filter : fitted.where) {
    const bool is_told = way && &filter == data::DirectionFilter(fitted.where);
    if (!is_told && table.Find(filter.column) >= 0) filters.push_back(filter);
  }
  if (way) filters.push_back({.column = kWayColumn, .value = *way});
  return filters;
}

std::vector<bool> RowsMadeFor(const FittedModel& fitted,
                              const data::CsvTable& table) {
  std::vector<bool> made_for(table.num_rows, true);
  for (const data::ColumnFilter& filter : FiltersFor(fitted, table)) {
    data::KeepPassing(table, filter, &made_for);
  }
  return made_for;
}

}  // namespace errmap::models
