#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace errmap::cli {

/// Any text as a TOML string, on one line.
std::string TomlText(std::string_view text);

/// A key: bare where TOML allows it, else quoted.
std::string TomlKey(std::string_view text);

/// ["a", "b"], a line per item where one line would be long.
std::string TomlList(const std::vector<std::string>& items);

}  // namespace errmap::cli
