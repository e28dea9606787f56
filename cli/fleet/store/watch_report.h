#pragma once

#include <limits>
#include <string>
#include <vector>

#include "cli/fleet/store/deployments.h"
#include "cli/report/table.h"

namespace errmap::fleet {

/// What watch found of one component.
struct WatchedComponent {
  Deployment deployment;
  std::string file;           // the newest measurements
  std::vector<Check> checks;  // all sessions so far, oldest first
  bool examined = false;      // new measurements could be read
  std::string why_not;        // a file could not, or nothing could be judged
  // Of the newest session, and what false discoveries allow for.
  models::WatchStatus status = models::WatchStatus::kNotJudged;
  double found = std::numeric_limits<double>::quiet_NaN();  // RMSE, its unit
  double p_map = std::numeric_limits<double>::quiet_NaN();  // NaN: not judged
  double rate_map = 0.0;
  double rate_sensor = 0.0;

  /// What should be done, "" where nothing.
  std::string Proposal(const std::string& store) const;
};

/// A row per component.
report::Table WatchTable(const std::vector<WatchedComponent>& components);

/// watch.html: the table, and the sessions of those that are not as promised
/// against what was promised.
std::string WatchHtml(const std::string& store,
                      const std::vector<WatchedComponent>& components);

}  // namespace errmap::fleet
