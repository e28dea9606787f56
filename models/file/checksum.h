#pragma once

#include <string>
#include <string_view>

namespace errmap::models {

/// The last key of a model file.
inline constexpr const char* kChecksumKey = "checksum";

/// `json`, the text of an object with at least one member, with its checksum as
/// one member more: the SHA-256 of all that stands before it, but for blanks
/// between tokens, so that a copy may be indented or have other ends of lines.
std::string WithChecksum(std::string json);

/// Whether `json` ends with `checksum` as WithChecksum wrote it, and is
/// otherwise what it was then.
bool HasChecksum(std::string_view json, std::string_view checksum);

}  // namespace errmap::models
