#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace errmap::data {

/// Writes a file whole or not at all: beside the target under a temporary
/// name, flushed to disk, then renamed over it. What a killed process left of
/// the same target goes with it. The parent folder must exist. A link at the
/// path is replaced, and what it leads to stays as it is; in the folder of
/// another user it is refused.
/// Throws std::system_error naming the path; the old file is left as it was.
void WriteFileAtomically(const std::string& path, std::string_view content);

/// The same without the flush to disk, for many files before one
/// FlushFileSystemOf: until then a power cut may leave them torn.
void WriteFileUnflushed(const std::string& path, std::string_view content);

/// Flushes all that was written to the file system that the folder is on.
/// Throws std::system_error naming it.
void FlushFileSystemOf(const std::string& folder);

/// Waits, a second at most, until no file is being written, and lets no thread
/// begin one: for a process that is about to end whatever its threads do.
void EndWriting();

/// Removes from `folder` what a killed process had begun to write; files that
/// another process is writing now stay, and what cannot be removed is let be.
void RemoveAbandonedFiles(const std::string& folder);

/// What no file of settings, maps or lists has more of: 4 MiB of text that
/// people write, 1 GiB of one that programs do.
inline constexpr std::size_t kMostTextOfPeople = std::size_t{4} << 20U;
inline constexpr std::size_t kMostTextOfPrograms = std::size_t{1} << 30U;

/// Whole content of a file, which may be a pipe that this process was given
/// open (/dev/stdin, /dev/fd/3); no other is read, since it may never get a
/// writer, nor is a device, which may never end. Throws InputError naming the
/// path, also where there are more than `most` bytes (0: a plain file may have
/// any number, a pipe up to kMostTextOfPrograms).
std::string ReadFile(const std::string& path, std::size_t most = 0);

}  // namespace errmap::data
