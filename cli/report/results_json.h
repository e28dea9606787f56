#pragma once

#include "cli/json_blocks.h"
#include "cli/study_file/comparison.h"

namespace errmap::cli {

/// One of the "components" of results.json.
Json ComponentJson(const Comparison& comparison);

}  // namespace errmap::cli
