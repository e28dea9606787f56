#pragma once

#include <cstddef>
#include <vector>

#include "cli/fleet/store/store_folder.h"
#include "cli/fleet/store/watch_report.h"
#include "cli/fleet/store/watched_files.h"

namespace errmap::fleet {

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
