#pragma once

#include <utility>

namespace errmap::data {

/// An open file, closed by the destructor; below 0: none.
class FileDescriptor {
 public:
  explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  FileDescriptor(FileDescriptor&& other) noexcept
      : descriptor_(other.Release()) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~FileDescriptor();

  int get() const { return descriptor_; }
  bool is_open() const { return descriptor_ >= 0; }

  /// Releases the descriptor, which the caller must close.
  int Release() { return std::exchange(descriptor_, -1); }

  /// Closes the file. Some file systems report a failed write only here.
  /// Returns 0 on success.
  int Close();

 private:
  int descriptor_;
};

}  // namespace errmap::data
