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
/// (data::InMapUnits), with help from the map. If each training file was a
/// session, each file here is one. A clock without a unit takes that of the map
/// if its steps then agree. Rows in another order are sorted by time, like
/// those of a fit. A remark names differences that affect the map's memory.
/// Throws data::InputError as these functions do.
data::TableForMap ReadForMap(const FittedModel& fitted,
                             const std::vector<std::string>& files,
                             MapColumns columns,
                             const MapDataArguments& arguments);

}  // namespace errmap::models
