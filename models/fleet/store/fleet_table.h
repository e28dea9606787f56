#pragma once

#include <string>
#include <vector>

#include "models/fleet/component_summary.h"
#include "models/report/table.h"

namespace errmap::fleet {

/// A row per component: what is recommended and how it does.
report::Table FleetTable(
    const std::vector<models::ComponentSummary>& summaries);

/// What compare --format prints of a fleet; on a terminal, of a large one, the
/// numbers and the components that failed or do worst.
std::string FormattedFleet(
    const std::vector<models::ComponentSummary>& summaries,
    const std::string& format);

}  // namespace errmap::fleet
