#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace errmap::desk {

/// Parts that a dotted key may have. A parser takes each for a table in a
/// table, and its stack ends before a long key does.
inline constexpr std::size_t kMostKeyParts = 64;

/// The line (from 1) where a TOML text has a key of more parts; 0: nowhere.
std::size_t LineOfLongKey(std::string_view text);

/// Any text as a TOML string, on one line.
std::string TomlText(std::string_view text);

/// A key: bare where TOML allows it, else quoted.
std::string TomlKey(std::string_view text);

/// ["a", "b"], a line per item where one line would be long.
std::string TomlList(const std::vector<std::string>& items);

}  // namespace errmap::desk
