#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cli/desk/plan/study_plan.h"
#include "cli/desk/study_config.h"
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

/// What a fleet may cost, from a sample of its components.
struct FleetPlan {
  std::int64_t components = 0;
  std::int64_t looked_at = 0;         // of them, evenly
  double fits = 0.0;                  // of all, as those looked at have
  double seconds = 0.0;               // on one processor
  double largest_mib = 0.0;           // memory of the largest looked at
  std::vector<std::string> unusable;  // of those looked at: why, a line each
};

/// Of an expanded study.
FleetPlan PlanFleet(const desk::StudyConfig& config);

/// A commented study file whose components are patterns, for the CSV files
/// below a folder: folders' names that differ become fields, and so do the
/// files' own; "x_down" with a word for a direction at its end is a component
/// and a direction. Files of one name are taken to be alike: any of the first
/// three of each tells that they can be mapped, so that a broken one among good
/// ones fails in the study, where it is named. `beside` is the folder as seen
/// from the study file, `usage` how such a study is run. Throws
/// data::InputError where no file can be mapped.
struct FleetProposal {
  std::string text;
  long long files = 0;             // that the patterns match
  std::set<std::string> left_out;  // names of those that cannot be mapped
};
FleetProposal ProposeFleet(const std::string& folder,
                           const std::string& beside,
                           const std::string& target,
                           const std::string& usage);

}  // namespace errmap::fleet
