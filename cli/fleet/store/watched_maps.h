#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/fleet/store/store_folder.h"
#include "cli/fleet/store/watch_report.h"

namespace errmap::fleet {

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
