#pragma once

#include <memory>

#include "cli/commands/studies/compare_arguments.h"
#include "cli/fleet/store/store_folder.h"

namespace errmap::cli {

/// `compare` for a study of many components, each studied separately. It
/// expands patterns, runs a share of a study (--shard), or continues with one
/// component.
std::unique_ptr<CompareMode> CompareFleet();

/// Turns the folder into a store, or checks that it already is one. Throws
/// UsageError if it holds other files, unless `force`.
void ClaimStore(const fleet::StorePaths& paths, bool force);

}  // namespace errmap::cli
