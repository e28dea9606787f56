#pragma once

#include <string>

#include "cli/comparison.h"

namespace errmap::cli {

/// The comparison as text for a terminal: what was compared, one row per
/// model with the hold-outs side by side, and the verdict in words.
std::string StudyTable(const Comparison& comparison);

}  // namespace errmap::cli
