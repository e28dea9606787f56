#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace errmap::data {

/// Whether the bytes begin as those of a zip archive do.
bool IsZip(std::string_view bytes);

/// The files of a zip archive (PKWARE's APPNOTE, stored or deflated, without
/// zip64). Names and sizes are those of its central directory.
class ZipArchive {
 public:
  /// `bytes` must outlive it. Throws InputError where they are no archive, are
  /// cut off, or a password is needed.
  explicit ZipArchive(std::string_view bytes);

  bool Has(std::string_view name) const { return entries_.contains(name); }
  /// Throws InputError where there is no such file, it is damaged, or it has
  /// more than `most` bytes.
  std::string Read(std::string_view name, std::size_t most) const;

 private:
  struct Entry {
    std::size_t offset = 0;  // of its own header
    std::size_t packed = 0;  // bytes
    std::uint32_t method = 0;
    std::uint32_t crc = 0;
  };

  std::uint32_t NumberAt(std::size_t offset, std::size_t bytes) const;
  std::size_t FindDirectory() const;

  std::string_view bytes_;
  std::map<std::string, Entry, std::less<>> entries_;
};

}  // namespace errmap::data
