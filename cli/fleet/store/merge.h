#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/fleet/store/component_summary.h"
#include "cli/fleet/store/store_folder.h"
#include "cli/report/plot.h"

namespace errmap::fleet {

/// What the shards of a study have left behind so far.
struct FleetSummaries {
  FleetRecord fleet;
  std::vector<ComponentSummary> summaries;  // in order of the fleet
  std::vector<std::string> missing;         // not there, or of another study
  std::string damaged;  // where a damaged errmap.sqlite was set aside, or ""
};

/// Reads every component's summary. Throws data::InputError where the folder is
/// no store.
FleetSummaries ReadSummaries(const StorePaths& paths);

/// Which are missing, and what to do; "" where none is.
std::string MissingWords(const FleetSummaries& found);

/// What is counted over some of the components.
struct FleetTally {
  std::int64_t components = 0;
  std::int64_t met = 0;
  std::int64_t missed = 0;  // only after re-zeroing, too
  std::int64_t without_goal = 0;
  std::int64_t failed = 0;
  double log_ratio = 0.0;  // sum of ln(after / before)
  std::int64_t ratios = 0;

  void Add(const ComponentSummary& summary);
  /// Of the error without a map, what is left: geometric mean.
  double Left() const;
};

/// report.html: one self-contained page of all components. Those whose own page
/// is there are linked; errmap report STORE --component NAME draws one.
std::string FleetReportHtml(const StorePaths& paths,
                            const FleetSummaries& found);
/// A page of a store, with the content of its <main>.
std::string StorePage(const std::string& title, const std::string& main);
/// A figure of such a page; `caption` is HTML.
std::string FigureHtml(const report::Plot& plot,
                       const std::string& caption,
                       const std::string& title,
                       const std::string& description);
/// Draws report.html.
void DrawFleetReport(const StorePaths& paths, const FleetSummaries& found);

/// Puts them into errmap.sqlite and report.html. A damaged errmap.sqlite is set
/// aside and written anew: what was deployed and watched is not in it then.
FleetSummaries MergeStore(const StorePaths& paths);

/// What compare --format prints of a fleet; on a terminal, of a large one, the
/// numbers and the components that failed or do worst, `columns` wide.
std::string FormattedFleet(const std::vector<ComponentSummary>& summaries,
                           const std::string& format,
                           std::size_t columns);

}  // namespace errmap::fleet
