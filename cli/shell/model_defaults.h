#pragma once

#include <map>
#include <string>

namespace errmap::cli {

/// Of a type of model's options, those that have a value unless others are
/// given, with it. Throws std::invalid_argument for a type that there is not.
std::map<std::string, std::string> ModelDefaults(const std::string& type);

}  // namespace errmap::cli
