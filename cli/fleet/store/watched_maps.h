#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cli/fleet/store/deployments.h"
#include "cli/fleet/store/store_folder.h"
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

/// A file of new measurements and the deployment that it is of.
struct WatchedFile {
  std::string file;
  const Deployment* deployment = nullptr;
};

struct WatchedFiles {
  std::vector<WatchedFile> files;    // in order of the deployments
  std::vector<std::string> unknown;  // of no deployment
  std::vector<std::string> remarks;  // why a file is of none, a line each
};

/// Finds whose measurements these are: `paths` are CSV files, folders with such
/// below them, or COMPONENT=FILE. A file is of the component of the study, be a
/// map deployed on it or not, whose data have the same name and the most of the
/// same folders above it; where two do alike it is of none, nor where it lies
/// in a folder of the study's that has no such component. Throws
/// data::InputError where a path is not there.
WatchedFiles FindWatchedFiles(const FleetRecord& study,
                              const std::vector<Deployment>& deployments,
                              const std::vector<std::string>& paths);

/// What new measurements say of the maps that are deployed.
struct WatchedMaps {
  std::vector<WatchedComponent> components;  // of which there are files
  std::ptrdiff_t as_studied = 0;  // files that are those of the study still
};

/// Holds each file, in the order of FindWatchedFiles, against the map that is
/// deployed on its component, its sessions with those that `store` knows of it,
/// and judges over all components together. A file that cannot be read or
/// judged says why in its component. Nothing is written.
WatchedMaps WatchMaps(const StorePaths& paths,
                      Database* store,
                      const std::vector<WatchedFile>& files);

}  // namespace errmap::fleet
