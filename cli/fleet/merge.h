#pragma once

#include <string>
#include <vector>

#include "cli/fleet/store_folder.h"
#include "models/fleet/component_summary.h"

namespace errmap::cli {

/// What the shards of a study have left behind so far.
struct FleetSummaries {
  FleetRecord fleet;
  std::vector<models::ComponentSummary> summaries;  // in order of the fleet
  std::vector<std::string> missing;  // not there, or of another study
};

/// Reads every component's summary. Throws data::InputError where the folder is
/// no store.
FleetSummaries ReadSummaries(const StorePaths& paths);

/// Draws report.html.
void DrawFleetReport(const StorePaths& paths, const FleetSummaries& found);

/// Puts them into errmap.sqlite and report.html and says on stderr what is
/// missing.
FleetSummaries MergeStore(const StorePaths& paths);

}  // namespace errmap::cli
