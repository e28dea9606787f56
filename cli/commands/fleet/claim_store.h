#pragma once

#include "cli/fleet/store/store_folder.h"

namespace errmap::cli {

/// Makes the folder a store, or finds that it is one. Throws UsageError where
/// it holds other files, unless `force`.
void ClaimStore(const fleet::StorePaths& paths, bool force);

}  // namespace errmap::cli
