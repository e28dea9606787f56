#pragma once

#include <functional>
#include <string>

#include "cli/fleet/run/fleet_run.h"

namespace errmap::cli {

/// Returns the value of an environment variable, or null.
using Environment = std::function<const char*(const char*)>;

/// Returns the share for "I/N", I from 0 to N - 1, or for "env". The latter is
/// the task's rank among those that a launcher started, from the first of
///
///   OMPI_COMM_WORLD_RANK of OMPI_COMM_WORLD_SIZE
///   PMI_RANK of PMI_SIZE
///   SLURM_PROCID of SLURM_NTASKS, if more than one
///   SLURM_ARRAY_TASK_ID in a whole array of SLURM_ARRAY_TASK_COUNT tasks
///
/// Throws UsageError if the text is neither, no variable is set, the values are
/// not a share, or the array has gaps.
fleet::Share ShareOf(const std::string& text, const Environment& environment);

}  // namespace errmap::cli
