#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cli/fleet/store/deployments.h"
#include "cli/report/table.h"

namespace errmap::fleet {

/// What watch found of one component.
struct WatchedComponent {
  Deployment deployment;
  std::string file;                  // the newest measurements
  std::vector<Check> checks;         // all sessions so far, oldest first
  bool examined = false;             // new measurements could be read
  std::ptrdiff_t file_sessions = 0;  // in that file
  std::string why_not;  // a file could not, or nothing could be judged
  // Of the newest session.
  models::WatchStatus status = models::WatchStatus::kNotJudged;
  double found = std::numeric_limits<double>::quiet_NaN();  // RMSE, its unit
  double p_map = std::numeric_limits<double>::quiet_NaN();  // NaN: not judged
  std::optional<models::MapJudgement> judgement;
  double indifference = 0.0;  // that never matters, its unit

  /// What should be done, "" where nothing.
  std::string Proposal(const std::string& store) const;
};

/// A row per component. `brief`: what a line of a terminal has room for.
report::Table WatchTable(const std::vector<WatchedComponent>& components,
                         bool brief = false);

/// "60 components, 57 as promised, 3 worse; of so many that are healthy 0.6 are
/// named worse or changed by chance".
std::string WatchHeadline(const std::vector<WatchedComponent>& components);

/// watch.html: how many are how and what to do for whom, the sessions of those
/// that are not as promised against what was promised, and the table.
std::string WatchHtml(const std::string& store,
                      const std::vector<WatchedComponent>& components);

}  // namespace errmap::fleet
