#pragma once

#include "cli/comparison.h"
#include "cli/json_blocks.h"

namespace errmap::cli {

/// One of the "components" of results.json.
Json ComponentJson(const Comparison& comparison);

}  // namespace errmap::cli
