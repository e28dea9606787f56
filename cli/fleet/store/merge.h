#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/fleet/store/component_summary.h"
#include "cli/fleet/store/store_folder.h"
#include "cli/report/plot.h"

namespace errmap::fleet {

/// The results that the shards of a study have written so far.
struct FleetSummaries {
  FleetRecord fleet;  // with a component for each way, if there are two
  std::vector<ComponentSummary> summaries;  // in order of the fleet
  std::vector<std::string> missing;         // not there, or of another study
  std::string damaged;  // where a damaged errmap.sqlite was set aside, or ""
};

/// Reads every component's summary. Throws data::InputError if the folder is
/// not a store.
FleetSummaries ReadSummaries(const StorePaths& paths);

/// Returns a message on missing components and what to do; "" if none is
/// missing.
std::string MissingWords(const FleetSummaries& found);

/// Counts over a subset of the components.
struct FleetTally {
  std::int64_t components = 0;
  std::int64_t met = 0;
  std::int64_t missed = 0;  // only after re-zeroing, too
  std::int64_t without_goal = 0;
  std::int64_t failed = 0;
  double log_ratio = 0.0;  // sum of ln(after / before)
  std::int64_t ratios = 0;

  void Add(const ComponentSummary& summary);
  /// Remaining error as a fraction of the error without a map: geometric mean.
  double Left() const;
};

/// Returns report.html: one self-contained page of all components. It links to
/// the pages of components that exist; `errmap report STORE --component NAME`
/// draws one.
std::string FleetReportHtml(const StorePaths& paths,
                            const FleetSummaries& found);
/// Returns a page of a store, with the content of its <main>.
std::string StorePage(const std::string& title, const std::string& main);
/// A figure of such a page; `caption` is HTML.
std::string FigureHtml(const report::Plot& plot,
                       const std::string& caption,
                       const std::string& title,
                       const std::string& description);
/// Draws report.html.
void DrawFleetReport(const StorePaths& paths, const FleetSummaries& found);

/// Writes the results into errmap.sqlite and report.html. A damaged
/// errmap.sqlite is renamed and replaced by a new one, without the records of
/// deploy and watch.
FleetSummaries MergeStore(const StorePaths& paths);

/// Returns the output of `compare --format` for a fleet. For a large fleet on a
/// terminal, `columns` wide, it is a summary, with the components that failed
/// or have the largest errors.
std::string FormattedFleet(const std::vector<ComponentSummary>& summaries,
                           const std::string& format,
                           std::size_t columns);

}  // namespace errmap::fleet
