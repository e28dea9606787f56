#pragma once

#include <string>
#include <string_view>

namespace errmap::models {

/// Last key of a model file.
inline constexpr const char* kChecksumKey = "checksum";

/// Returns `json`, an object with at least one member, with its checksum as a
/// further member: the SHA-256 of all text before it, without blanks between
/// tokens. So a copy may have other indentation or line ends.
std::string WithChecksum(std::string json);

/// Returns true if `json` ends with `checksum` as written by WithChecksum, and
/// the text before it is unchanged.
bool HasChecksum(std::string_view json, std::string_view checksum);

}  // namespace errmap::models
