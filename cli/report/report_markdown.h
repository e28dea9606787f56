#pragma once

#include <string>

#include "cli/json_blocks.h"

namespace errmap::cli {

/// report.md: the answer, the tables and the equations of results.json, for
/// repositories; no figures.
std::string ReportMarkdown(const Json& results);

}  // namespace errmap::cli
