#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace errmap::data {

/// Writes a file completely or not at all: under a temporary name beside the
/// target, flushed to disk, then renamed over it. Also removes what a killed
/// process left of the same target. The parent folder must exist. A link at the
/// path is replaced, and the file to which it points stays unchanged. In
/// another user's folder a link is refused. Throws std::system_error naming the
/// path; the old file is then unchanged.
void WriteFileAtomically(const std::string& path, std::string_view content);

/// Writes a file as above, without the flush to disk, for many files before one
/// FlushFileSystemOf. Until then a power cut may leave them incomplete.
void WriteFileUnflushed(const std::string& path, std::string_view content);

/// Flushes everything written to the file system of the folder. Throws
/// std::system_error naming it.
void FlushFileSystemOf(const std::string& folder);

/// Waits at most a second until no file is being written, and prevents threads
/// from beginning one. For a process that is about to end while its threads
/// still run.
void EndWriting();

/// Removes partial files of a killed process from `folder`. Leaves files that
/// another process is writing now, and those that cannot be removed.
void RemoveAbandonedFiles(const std::string& folder);

/// Size limits of a file of settings, maps or lists: 4 MiB for text that people
/// write, 1 GiB for text that programs write.
inline constexpr std::size_t kMostTextOfPeople = std::size_t{4} << 20U;
inline constexpr std::size_t kMostTextOfPrograms = std::size_t{1} << 30U;

/// Returns the content of a file. It may be a pipe that this process was given
/// open (/dev/stdin, /dev/fd/3). Other pipes and devices are refused, since
/// they may never end. Throws InputError naming the path, also if there are
/// more than `most` bytes. 0: no limit for a plain file, kMostTextOfPrograms
/// for a pipe.
std::string ReadFile(const std::string& path, std::size_t most = 0);

}  // namespace errmap::data
