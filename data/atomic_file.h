#pragma once

#include <string>
#include <string_view>

namespace errmap::data {

/// Writes a file whole or not at all: beside the target under a temporary
/// name, flushed to disk, then renamed over it. The parent folder must exist.
/// Throws std::system_error naming the path; the old file is left as it was.
void WriteFileAtomically(const std::string& path, std::string_view content);

/// Removes from `folder` what a killed process had begun to write; files that
/// another process is writing now stay, and what cannot be removed is let be.
void RemoveAbandonedFiles(const std::string& folder);

/// Whole content of a file. Throws InputError naming the path.
std::string ReadFile(const std::string& path);

}  // namespace errmap::data
