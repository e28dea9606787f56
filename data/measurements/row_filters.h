#pragma once

#include <span>
#include <string>

#include "data/measurements/dataset.h"

namespace errmap::data {

/// Returns the filter for a direction of motion, recognised by its column
/// ("direction", "approach") or its word; null if there is none.
const ColumnFilter* DirectionFilter(std::span<const ColumnFilter> filters);

/// "direction down and tool 3"; "" for none.
std::string FiltersText(std::span<const ColumnFilter> filters);

}  // namespace errmap::data
