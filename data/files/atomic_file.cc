#include "data/files/atomic_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <fcntl.h>
#include <filesystem>
#include <optional>
#include <random>
#include <string_view>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

#include <sys/file.h>
#include <sys/stat.h>

#include "data/files/file_descriptor.h"
#include "data/files/link.h"
#include "data/files/sheet_path.h"
#include "data/files_in_memory.h"
#include "data/input_error.h"
#include "data/text.h"

namespace errmap::data {
namespace {

constexpr mode_t kPermissionBits = 07777;
constexpr mode_t kNewFileMode = 0666;  // less the umask
constexpr mode_t kPrivateMode = 0600;

// Removes the temporary file unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string path) : path_(std::move(path)) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (!path_.empty()) unlink(path_.c_str());
  }

  const std::string& path() const { return path_; }
  void Release() { path_.clear(); }

 private:
  std::string path_;
};

[[noreturn]] void ThrowUnwritable(const std::string& path, int error) {
  throw std::system_error(
      error, std::generic_category(), "cannot write " + PrintablePath(path));
}

[[noreturn]] void ThrowUnreadable(const std::string& path, int error) {
  throw InputError(PrintablePath(path) + ": cannot be read: " +
                   std::generic_category().message(error) +
                   "; check the path and its permissions");
}

[[noreturn]] void Refuse(const std::string& path, const std::string& why) {
  throw InputError(PrintablePath(path) + ": " + why);
}

void WriteAll(const FileDescriptor& file,
              std::string_view content,
              const std::string& path) {
  while (!content.empty()) {
    const ssize_t written = write(file.get(), content.data(), content.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      ThrowUnwritable(path, errno);
    }
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

// Names of open descriptors. They may lead to a regular file (a redirected
// standard output), which must be added to and not replaced.
bool NamesOpenDescriptor(std::string_view path) {
  return path == "/dev/stdin" || path == "/dev/stdout" ||
         path == "/dev/stderr" || path.starts_with("/dev/fd/") ||
         path.starts_with("/proc/self/fd/");
}

// A terminal is read until its user ends it, and /dev/null ends at once.
bool IsEndlessDevice(int descriptor, const struct stat& status) {
  if (S_ISBLK(status.st_mode)) return true;
  if (!S_ISCHR(status.st_mode) || isatty(descriptor) == 1) return false;
  struct stat null {};
  return stat("/dev/null", &null) != 0 || null.st_rdev != status.st_rdev;
}

void WriteDirectly(const std::string& path, std::string_view content) {
  const FileDescriptor file(
      open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOCTTY));
  if (!file.is_open()) ThrowUnwritable(path, errno);
  WriteAll(file, content, path);
}

constexpr std::string_view kTemporaryBegin = ".errmap-";
constexpr std::string_view kTemporaryEnd = ".tmp";
constexpr std::string_view kLetters = "0123456789abcdef";
constexpr int kNumLetters = 16;

std::string TemporaryName(std::uint64_t number) {
  // Without the target's own name, which may already be as long as allowed.
  std::string name{kTemporaryBegin};
  for (int i = 0; i < kNumLetters; ++i) {
    constexpr int kBitsOfALetter = 4;
    name += kLetters[number >> (i * kBitsOfALetter) & 15U];
  }
  name += kTemporaryEnd;
  return name;
}

// The first choice for a target is always the same, so that writing it again
// finds what a killed process left (FNV-1a, 64 bits).
std::string TemporaryNameFor(std::string_view target) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char letter : target) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
  }
  return TemporaryName(hash);
}

std::string RandomTemporaryName() {
  std::random_device random;
  constexpr int kHalf = 32;
  return TemporaryName(std::uint64_t{random()} << kHalf | random());
}

bool IsTemporaryName(std::string_view name) {
  if (!name.starts_with(kTemporaryBegin) || !name.ends_with(kTemporaryEnd)) {
    return false;
  }
  name.remove_prefix(kTemporaryBegin.size());
  name.remove_suffix(kTemporaryEnd.size());
  return name.size() == kNumLetters &&
         name.find_first_not_of(kLetters) == std::string_view::npos;
}

// What a killed process left; a file that is being written is locked. Who
// holds the lock of what has the name is the only one to take the name away.
void RemoveIfAbandoned(const std::string& path) {
  const FileDescriptor file(
      open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat opened {};
  struct stat named {};
  if (file.is_open() && flock(file.get(), LOCK_EX | LOCK_NB) == 0 &&
      fstat(file.get(), &opened) == 0 && lstat(path.c_str(), &named) == 0 &&
      opened.st_ino == named.st_ino && opened.st_dev == named.st_dev) {
    unlink(path.c_str());
  }
}

struct OpenTemporary {
  std::string path;
  FileDescriptor file;
};

// A new file beside the target, locked, which says that it is not abandoned;
// not open, and errno says why, where there can be none.
OpenTemporary MakeTemporary(const std::filesystem::path& target, mode_t mode) {
  const std::filesystem::path folder =
      target.has_parent_path() ? target.parent_path() : ".";
  std::string path = folder / TemporaryNameFor(target.filename().string());
  RemoveIfAbandoned(path);
  for (;;) {
    FileDescriptor file(
        open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
    // Between opening and locking another process may take it for abandoned.
    // A file system without locks does no harm.
    struct stat status {};
    const bool is_ours = file.is_open()
                             ? (flock(file.get(), LOCK_EX | LOCK_NB) == 0 ||
                                errno != EWOULDBLOCK) &&
                                   fstat(file.get(), &status) == 0 &&
                                   status.st_nlink > 0
                             : errno != EEXIST;
    if (is_ours) return {std::move(path), std::move(file)};
    path = folder / RandomTemporaryName();
  }
}

// Makes the rename survive a power cut. The new file is in place by now, so a
// file system that cannot flush a folder is no reason to report a failure.
void FlushFolder(const std::filesystem::path& folder) {
  const FileDescriptor descriptor(
      open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.is_open()) fsync(descriptor.get());
}

std::atomic<int> num_writing = 0;
std::atomic<bool> writing_has_ended = false;

// Lives while a file is written. Counted before it looks, so that either it
// sees the end or the end sees it.
class Writing {
 public:
  Writing() {
    ++num_writing;
    if (!writing_has_ended) return;
    --num_writing;
    for (;;) pause();
  }
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;
  ~Writing() { --num_writing; }
};

enum class Flush { kNow, kLater };

void ReplaceFile(const std::string& path,
                 std::string_view content,
                 std::optional<mode_t> old_permissions,
                 Flush flush) {
  const std::filesystem::path target = path;
  const Writing writing;
  // Never open to more people than the old file was, not even for a moment.
  auto [temporary_name, file] =
      MakeTemporary(target, old_permissions ? kPrivateMode : kNewFileMode);
  if (!file.is_open()) ThrowUnwritable(path, errno);
  TemporaryFile temporary(std::move(temporary_name));
  // Holds the lock until the file has its own name.
  const FileDescriptor lock(fcntl(file.get(), F_DUPFD_CLOEXEC, 0));
  WriteAll(file, content, path);
  if (old_permissions && fchmod(file.get(), *old_permissions) != 0) {
    ThrowUnwritable(path, errno);
  }
  if (flush == Flush::kNow && fsync(file.get()) != 0) {
    ThrowUnwritable(path, errno);
  }
  if (file.Close() != 0) ThrowUnwritable(path, errno);
  if (rename(temporary.path().c_str(), target.c_str()) != 0) {
    ThrowUnwritable(path, errno);
  }
  temporary.Release();
  if (flush == Flush::kLater) return;
  FlushFolder(target.has_parent_path() ? target.parent_path() : ".");
}

// A link gives way to the file: what it leads to belongs to somebody else.
void ReplaceLink(const std::string& path,
                 std::string_view content,
                 Flush flush) {
  struct stat behind {};
  const bool leads_somewhere = stat(path.c_str(), &behind) == 0;
  if (leads_somewhere && S_ISDIR(behind.st_mode)) ThrowUnwritable(path, EISDIR);
  if (leads_somewhere && !S_ISREG(behind.st_mode)) {
    WriteDirectly(path, content);
    return;
  }
  RequireOwnLink(path);
  ReplaceFile(path, content, std::nullopt, flush);
}

void WriteFile(const std::string& path, std::string_view content, Flush flush) {
  if (NamesOpenDescriptor(path)) {
    WriteDirectly(path, content);
    return;
  }
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0) {
    if (errno != ENOENT) ThrowUnwritable(path, errno);
    ReplaceFile(path, content, std::nullopt, flush);
  } else if (S_ISLNK(status.st_mode)) {
    ReplaceLink(path, content, flush);
  } else if (S_ISDIR(status.st_mode)) {
    ThrowUnwritable(path, EISDIR);
  } else if (S_ISREG(status.st_mode)) {
    ReplaceFile(path, content, status.st_mode & kPermissionBits, flush);
  } else {
    WriteDirectly(path, content);
  }
}

}  // namespace

void WriteFileAtomically(const std::string& path, std::string_view content) {
  WriteFile(path, content, Flush::kNow);
}

void WriteFileUnflushed(const std::string& path, std::string_view content) {
  WriteFile(path, content, Flush::kLater);
}

void FlushFileSystemOf(const std::string& folder) {
  const FileDescriptor descriptor(
      open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!descriptor.is_open() || syncfs(descriptor.get()) != 0) {
    ThrowUnwritable(folder, errno);
  }
}

void EndWriting() {
  constexpr int kMostMilliseconds = 1000;
  writing_has_ended = true;
  for (int waited = 0; num_writing > 0 && waited < kMostMilliseconds;
       ++waited) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void RemoveAbandonedFiles(const std::string& folder) {
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end;
       !error && entry != end;
       entry.increment(error)) {
    const std::filesystem::path& path = entry->path();
    if (IsTemporaryName(path.filename().string())) RemoveIfAbandoned(path);
  }
}

std::string ReadFile(const std::string& path_or_sheet, std::size_t most) {
  if (const std::string* const text = FilesInMemory::FindText(path_or_sheet)) {
    return *text;
  }
  const std::string path = SplitSheetPath(path_or_sheet).file;
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) ThrowUnreadable(path, errno);
  // Before the opening, which would wait for a writer.
  if (S_ISFIFO(status.st_mode) && !NamesOpenDescriptor(path)) {
    Refuse(path,
           "is a named pipe, which may never end; write to a file, or pipe "
           "into /dev/stdin");
  }
  const FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.is_open() || fstat(file.get(), &status) != 0) {
    ThrowUnreadable(path, errno);
  }
  if (IsEndlessDevice(file.get(), status)) {
    Refuse(path, "is a device, which may never end; name a file");
  }
  if (most == 0 && !S_ISREG(status.st_mode)) most = kMostTextOfPrograms;
  // One byte more than the file says, so that its end is seen without growing.
  // Pipes and the kernel's own files say 0 and are read by growing.
  constexpr std::size_t kLeast = 1U << 16U;
  std::string content;
  if (S_ISREG(status.st_mode) && status.st_size > 0 &&
      (most == 0 || static_cast<std::size_t>(status.st_size) <= most)) {
    content.resize(static_cast<std::size_t>(status.st_size) + 1);
  }
  std::size_t size = 0;
  for (;;) {
    if (size == content.size()) content.resize(std::max(kLeast, 2 * size));
    const ssize_t count =
        read(file.get(), content.data() + size, content.size() - size);
    if (count < 0) {
      if (errno == EINTR) continue;
      ThrowUnreadable(path, errno);
    }
    if (count == 0) break;
    size += static_cast<std::size_t>(count);
    if (most > 0 && size > most) {
      Refuse(path,
             "is longer than " + std::to_string(most >> 20U) +
                 " MiB, more than a file of its kind can have");
    }
  }
  content.resize(size);
  return content;
}

}  // namespace errmap::data
