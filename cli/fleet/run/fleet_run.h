#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cli/fleet/run/component_pattern.h"
#include "cli/fleet/store/store_folder.h"
#include "cli/study_setup/plan/study_plan.h"
#include "cli/study_setup/study_config.h"

namespace errmap::fleet {

/// The content of fleet.json for an expanded study, sorted by name.
FleetRecord FleetOf(const FleetStudy& study, const std::string& command_line);

/// The share of a fleet's components that one task studies: number `index` of
/// `count`, from 0.
struct Share {
  std::int64_t index = 0;
  std::int64_t count = 1;

  /// Assigned by a hash of the name (the first 8 bytes of its SHA-256, modulo
  /// `count`), so that adding or removing a component moves no other.
  bool Has(std::string_view name) const;
};

struct FleetRunOptions {
  int jobs = 1;  // components at a time
  const std::atomic<bool>* stop = nullptr;
  Share share = {};
  std::string command_line;
  study_setup::Remark remark =
      {};  // told of each component that failed, one at a time
  /// Called with (components done, components in the share), by one thread at a
  /// time; may be empty.
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
/// the store. Files of other components are not touched. If a component cannot
/// be read or fitted, its summary says why. Results of an earlier run with the
/// same data and settings are kept. Throws std::system_error if the store
/// cannot be written.
FleetRunResult RunFleet(const FleetStudy& study,
                        const StorePaths& store,
                        const FleetRunOptions& options);

/// Estimated cost of a fleet, from a sample of its components.
struct FleetPlan {
  std::int64_t components = 0;
  std::int64_t looked_at = 0;         // of them, evenly
  double fits = 0.0;                  // of all, as those looked at have
  double seconds = 0.0;               // on one processor
  double largest_mib = 0.0;           // memory of the largest looked at
  std::vector<std::string> unusable;  // of those looked at: why, a line each
};

/// Estimates the cost of an expanded study.
FleetPlan PlanFleet(const study_setup::StudyConfig& config);

/// Returns a commented study file whose components are patterns for the CSV
/// files below a folder. Differing folder names and file names become fields.
/// "x_down", with a word for a direction at its end, is a component and a
/// direction. Files of the same name are assumed to be alike. One usable file
/// among the first three of each name is enough, so that a broken file fails
/// later, in the study, which names it. `beside` is the folder as seen from the
/// study file; `usage` is the command that runs such a study. Throws
/// data::InputError if no file can be mapped.
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
