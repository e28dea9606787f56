#pragma once

#include <string>

#include "cli/study_file/comparison.h"

namespace errmap::cli {

/// results.json, schema errmap-results-1.
std::string ResultsJson(const StudyRun& run);

}  // namespace errmap::cli
