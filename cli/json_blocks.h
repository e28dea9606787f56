#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/desk/provenance.h"

namespace errmap::cli {

using Json = nlohmann::ordered_json;

/// A document as every command prints it; numbers that are not finite are null.
std::string DumpJson(const Json& document);

/// The block "provenance" of every document: {"version", "command_line",
/// "configuration", "inputs": [{"file","sha256"}], "compiler", "libraries":
/// {name: version}, "platform"}. `configuration` is what took effect, defaults
/// included; null where there is none.
Json ProvenanceJson(const std::string& command_line,
                    const Json& configuration,
                    const std::vector<desk::InputFile>& inputs);

}  // namespace errmap::cli
