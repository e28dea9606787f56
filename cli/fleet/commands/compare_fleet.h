#pragma once

#include <memory>

#include "cli/commands/studies/compare_arguments.h"
#include "cli/fleet/store/store_folder.h"

namespace errmap::cli {

/// compare of a study of many components, each by itself: components from
/// patterns, a share of a study (--shard), or what goes on with one.
std::unique_ptr<CompareMode> CompareFleet();

/// Makes the folder a store, or finds that it is one. Throws UsageError where
/// it holds other files, unless `force`.
void ClaimStore(const fleet::StorePaths& paths, bool force);

}  // namespace errmap::cli
