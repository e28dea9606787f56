#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace errmap::cli {

using Json = nlohmann::ordered_json;

/// A document as every command prints it.
std::string DumpJson(const Json& document);

}  // namespace errmap::cli
