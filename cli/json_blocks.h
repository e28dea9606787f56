#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/study_setup/provenance.h"

namespace errmap::cli {

using Json = nlohmann::ordered_json;

/// Returns a document as every command prints it. Numbers that are not finite
/// become null.
std::string DumpJson(const Json& document);

/// The block "provenance" of every document: {"version", "command_line",
/// "configuration", "inputs": [{"file","sha256"}], "compiler", "libraries":
/// {name: version}, "platform"}. `configuration` has the settings in effect,
/// including defaults; null if there are none.
Json ProvenanceJson(const std::string& command_line,
                    const Json& configuration,
                    const std::vector<study_setup::InputFile>& inputs);

}  // namespace errmap::cli
