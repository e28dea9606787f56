#pragma once

#include <utility>

namespace errmap::data {

/// An open file that is closed with its owner; below 0: none.
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

  /// The descriptor, which is the caller's to close from now on.
  int Release() { return std::exchange(descriptor_, -1); }

  /// Some file systems report a failed write only here. 0 where all is well.
  int Close();

 private:
  int descriptor_;
};

}  // namespace errmap::data
