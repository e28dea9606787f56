#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/fleet/store/deployments.h"
#include "cli/fleet/store/store_folder.h"
#include "cli/report/table.h"
#include "stats/not_a_number.h"

namespace errmap::fleet {

/// The result of `watch` for one component.
struct WatchedComponent {
  Deployment deployment;
  std::string file;                  // the newest measurements
  std::vector<Check> checks;         // all sessions so far, oldest first
  bool examined = false;             // new measurements could be read
  std::ptrdiff_t file_sessions = 0;  // in that file
  std::string why_not;  // a file could not, or nothing could be judged
  // Of the newest session.
  models::WatchStatus status = models::WatchStatus::kNotJudged;
  double found = stats::kNaN;  // RMSE, its unit
  double p_map = stats::kNaN;  // NaN: not judged
  std::optional<models::MapJudgement> judgement;
  double indifference = 0.0;  // that never matters, its unit

  /// Advice on what to do; "" if nothing needs to be done.
  std::string Proposal(const std::string& store) const;
};

/// Returns a row for each component. `brief`: only the columns that fit a
/// terminal.
report::Table WatchTable(const std::vector<WatchedComponent>& components,
                         bool brief = false);

/// "60 components, 57 as promised, 3 worse; by chance, 0.3 of 60 healthy ones
/// would be called worse or changed".
std::string WatchHeadline(const std::vector<WatchedComponent>& components);

/// Returns watch.html: the number of components in each state, what to do, the
/// sessions of components that are not as promised, and the table.
std::string WatchHtml(const std::string& store,
                      const std::vector<WatchedComponent>& components);

/// A file of new measurements and the deployment to which it belongs.
struct WatchedFile {
  std::string file;
  const Deployment* deployment = nullptr;
};

struct WatchedFiles {
  std::vector<WatchedFile> files;    // in order of the deployments
  std::vector<std::string> unknown;  // of no deployment
  std::vector<std::string> remarks;  // why a file is of none, a line each
};

/// Finds the deployment to which each file of new measurements belongs. `paths`
/// are CSV files, folders of such files, or COMPONENT=FILE. A file belongs to
/// the component whose data file has the same name and shares most folders
/// above it. That component need not have a deployed map. It belongs to none in
/// a tie, or if it lies in a folder of the study without such a component.
/// Throws data::InputError if a path does not exist.
WatchedFiles FindWatchedFiles(const FleetRecord& study,
                              const std::vector<Deployment>& deployments,
                              const std::vector<std::string>& paths);

/// Results of new measurements for the deployed maps.
struct WatchedMaps {
  std::vector<WatchedComponent> components;  // of which there are files
  std::ptrdiff_t as_studied = 0;  // files that are those of the study still
};

/// Compares each file, in the order of FindWatchedFiles, with the map deployed
/// on its component. The file's sessions are judged together with earlier ones
/// in `store`. If a file cannot be read or judged, its component has the
/// reason. Writes nothing.
WatchedMaps WatchMaps(const StorePaths& paths,
                      Database* store,
                      const std::vector<WatchedFile>& files);

}  // namespace errmap::fleet
