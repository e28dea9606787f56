#pragma once

#include <string>

#include "cli/study_file/comparison.h"

namespace errmap::cli {

/// The comparison as text for a terminal: what was compared, one row per
/// model with the hold-outs side by side, and the verdict in words.
std::string ComponentTable(const Comparison& comparison);

/// Those of all components, each under its name where there are several.
std::string StudyTable(const StudyRun& run);

}  // namespace errmap::cli
