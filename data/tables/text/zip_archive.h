#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace errmap::data {

/// True if the bytes begin like a zip archive.
bool IsZip(std::string_view bytes);

/// Reads the files of a zip archive in memory, by minizip.
class ZipArchive {
 public:
  /// `bytes` must outlive it. Throws InputError if they are not an archive or
  /// are cut off.
  explicit ZipArchive(std::string_view bytes);

  bool Has(const std::string& name) const;
  /// Throws InputError if there is no such file, or it is damaged, needs a
  /// password, or has more than `most` bytes.
  std::string Read(const std::string& name, std::size_t most) const;

 private:
  std::unique_ptr<void, int (*)(void*)> file_;
};

}  // namespace errmap::data
