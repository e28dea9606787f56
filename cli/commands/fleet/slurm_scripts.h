#pragma once

#include <cstdint>
#include <string>

#include "cli/fleet/run/fleet_plan.h"

namespace errmap::cli {

/// A job array of Slurm's that does the shares of a fleet, and a job behind it
/// that puts them together.
struct SlurmJob {
  std::string program;  // absolute, as all paths
  std::string config;
  std::string store;
  std::string folder;  // of the scripts and the logs
  std::int64_t tasks = 1;
  int cpus = 1;
  fleet::FleetPlan plan;
};

/// Each a shell script that people may read and change.
std::string ShardsScript(const SlurmJob& job);
std::string MergeScript(const SlurmJob& job);
std::string SubmitScript(const SlurmJob& job);

}  // namespace errmap::cli
