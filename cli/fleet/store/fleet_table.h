#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "models/fleet/component_summary.h"

namespace errmap::fleet {

/// What compare --format prints of a fleet; on a terminal, of a large one, the
/// numbers and the components that failed or do worst, `columns` wide.
std::string FormattedFleet(
    const std::vector<models::ComponentSummary>& summaries,
    const std::string& format,
    std::size_t columns);

}  // namespace errmap::fleet
