#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "cli/desk/plan/study_plan.h"
#include "cli/desk/toml/study_file.h"
#include "cli/fleet/store/store_folder.h"
#include "models/fleet/share.h"

namespace errmap::fleet {

/// The study with its patterns filled in, every component named. Throws
/// data::InputError where two have one name.
desk::StudyFile ExpandFleet(desk::StudyFile study);

/// What fleet.json says of an expanded study, in order of the names.
FleetRecord FleetOf(const desk::StudyFile& study,
                    const std::string& command_line);

struct FleetRunOptions {
  int jobs = 1;  // components at a time
  const std::atomic<bool>* stop = nullptr;
  models::Share share = {};
  std::string command_line;
  desk::Remark remark =
      {};  // told of each component that failed, one at a time
  /// Told (components done, of the share), one call at a time; may be empty.
  std::function<void(int, int)> progress = {};
};

struct FleetRunResult {
  int components = 0;  // of the share
  int fitted = 0;
  int kept = 0;  // nothing has changed since they were fitted
  int failed = 0;
  bool interrupted = false;
};

/// Studies the share's components one by one and writes the files of each into
/// the store; files of others are not touched. A component that cannot be read
/// or fitted has a summary that says so. What is there from an earlier run of
/// the same data and words stays. Throws std::system_error where nothing can be
/// written.
FleetRunResult RunFleet(const desk::StudyFile& study,
                        const StorePaths& store,
                        const FleetRunOptions& options);

}  // namespace errmap::fleet
