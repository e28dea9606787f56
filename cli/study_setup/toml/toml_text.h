#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::study_setup {

/// The most parts that a dotted key may have. The parser nests a table for each
/// part, so a long key would overflow its stack.
inline constexpr std::size_t kMostKeyParts = 64;

/// Returns the line (from 1) of a key with more parts, or 0 if there is none.
std::size_t LineOfLongKey(std::string_view text);

/// Returns any text as a TOML string on one line.
std::string TomlText(std::string_view text);

/// Returns a key: bare if TOML allows it, else quoted.
std::string TomlKey(std::string_view text);

/// Returns ["a", "b"], with a line for each item if one line would be long.
std::string TomlList(const std::vector<std::string>& items);

}  // namespace errmap::study_setup
