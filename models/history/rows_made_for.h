#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "models/error_model.h"

namespace errmap::models {

/// The column of directions, "up" and "down", that ReadForMap adds to a table.
/// It does so if the rows move in another direction than that of the map, or
/// name it differently.
inline constexpr const char* kWayColumn = "direction of motion";

/// Returns the direction along the axis for which the map is made: that of its
/// filter, else that of all its training rows. Nothing if these moved in both
/// directions.
std::optional<std::string> WayOf(const FittedModel& fitted);

/// Returns the filters for the map's rows, as far as the table has their
/// columns.
std::vector<data::ColumnFilter> FiltersFor(const FittedModel& fitted,
                                           const data::CsvTable& table);

/// Returns, for each row of the table, false if the map is known not to be made
/// for it.
std::vector<bool> RowsMadeFor(const FittedModel& fitted,
                              const data::CsvTable& table);

}  // namespace errmap::models
