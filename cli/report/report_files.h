#pragma once

#include <string>

#include "cli/json_blocks.h"

namespace errmap::cli {

/// Draws FOLDER/report.html and FOLDER/report.md from results.json, the
/// document as it stands in the file (DumpJson, parsed): so `errmap report`
/// draws the same bytes later. Each file appears whole or not at all. Throws
/// std::system_error naming what could not be written.
void WriteReport(const Json& results, const std::string& folder);

}  // namespace errmap::cli
