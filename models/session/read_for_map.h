#pragma once

#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/column_match.h"
#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/history/map_log.h"

namespace errmap::models {

enum class MapColumns { kInputs, kInputsAndTarget };

/// Reads files (data::ReadTables) in the names and units of the map
/// (data::InMapUnits), with what else the map knows of its own: where it knows
/// its sessions by the file, one file is one session; a clock that states no
/// unit counts in the map's where it then goes at its pace. Rows in another
/// order are put in that of time, as those that a map is fitted to are. A
/// remark tells what the map's memory was not fitted to. Throws
/// data::InputError as these functions do.
data::TableForMap ReadForMap(const FittedModel& fitted,
                             const std::vector<std::string>& files,
                             MapColumns columns,
                             const MapDataArguments& arguments);

/// The columns of times and sessions of a table for the map, as far as they are
/// known.
data::DatasetSelection SelectionOfRows(const FittedModel& fitted,
                                       const data::CsvTable& table,
                                       const MapDataArguments& arguments);

}  // namespace errmap::models
