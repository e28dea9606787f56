#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "cli/desk/plan/study_plan.h"
#include "cli/fleet/run/component_pattern.h"
#include "cli/fleet/store/store_folder.h"

namespace errmap::fleet {

/// What fleet.json says of an expanded study, in order of the names.
FleetRecord FleetOf(const FleetStudy& study, const std::string& command_line);

/// The share of a fleet's components that one task does: number `index` of
/// `count`, from 0.
struct Share {
  std::int64_t index = 0;
  std::int64_t count = 1;

  /// Dealt by a hash of the name (its SHA-256's first 8 bytes, modulo `count`),
  /// so that a component more or less moves no other.
  bool Has(std::string_view name) const;
};

struct FleetRunOptions {
  int jobs = 1;  // components at a time
  const std::atomic<bool>* stop = nullptr;
  Share share = {};
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
FleetRunResult RunFleet(const FleetStudy& study,
                        const StorePaths& store,
                        const FleetRunOptions& options);

}  // namespace errmap::fleet
