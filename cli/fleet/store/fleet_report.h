#pragma once

#include <string>

#include "cli/fleet/store/merge.h"

namespace errmap::fleet {

/// report.html of a store: one self-contained page of all components. Those
/// whose own page is there are linked; errmap report STORE --component NAME
/// draws one.
std::string FleetReportHtml(const StorePaths& paths,
                            const FleetSummaries& found);

}  // namespace errmap::fleet
