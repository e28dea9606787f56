#pragma once

#include <string>
#include <vector>

#include "cli/fleet/store/store_folder.h"
#include "models/fleet/component_summary.h"

namespace errmap::fleet {

/// What the shards of a study have left behind so far.
struct FleetSummaries {
  FleetRecord fleet;
  std::vector<models::ComponentSummary> summaries;  // in order of the fleet
  std::vector<std::string> missing;  // not there, or of another study
  std::string damaged;  // where a damaged errmap.sqlite was set aside, or ""
};

/// Reads every component's summary. Throws data::InputError where the folder is
/// no store.
FleetSummaries ReadSummaries(const StorePaths& paths);

/// Which are missing, and what to do; "" where none is.
std::string MissingWords(const FleetSummaries& found);

/// Draws report.html.
void DrawFleetReport(const StorePaths& paths, const FleetSummaries& found);

/// Puts them into errmap.sqlite and report.html. A damaged errmap.sqlite is set
/// aside and written anew: what was deployed and watched is not in it then.
FleetSummaries MergeStore(const StorePaths& paths);

}  // namespace errmap::fleet
