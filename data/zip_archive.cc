#include "data/zip_archive.h"

#include <algorithm>

#include "data/gzip.h"
#include "data/input_error.h"
#include "data/text.h"

namespace errmap::data {
namespace {

constexpr std::string_view kFile = "PK\x03\x04";
constexpr std::string_view kInDirectory = "PK\x01\x02";
constexpr std::string_view kEnd = "PK\x05\x06";

[[noreturn]] void ThrowDamaged() {
  throw InputError(
      "is a spreadsheet or an archive that is damaged; save it anew");
}

}  // namespace

bool IsZip(std::string_view bytes) { return bytes.starts_with(kFile); }

ZipArchive::ZipArchive(std::string_view bytes) : bytes_(bytes) {
  const std::size_t end = FindDirectory();
  std::size_t count = NumberAt(end + 10, 2);
  std::size_t at = NumberAt(end + 16, 4);
  for (; count > 0; --count) {
    constexpr std::size_t kFixed = 46;
    constexpr std::uint32_t kEncrypted = 1;
    if (!bytes_.substr(std::min(at, bytes_.size())).starts_with(kInDirectory)) {
      ThrowDamaged();
    }
    if ((NumberAt(at + 8, 2) & kEncrypted) != 0) {
      throw InputError("is protected by a password; save it without");
    }
    const std::size_t name_size = NumberAt(at + 28, 2);
    const std::size_t next =
        at + kFixed + name_size + NumberAt(at + 30, 2) + NumberAt(at + 32, 2);
    if (next > bytes_.size()) ThrowDamaged();
    entries_.emplace(bytes_.substr(at + kFixed, name_size),
                     Entry{.offset = NumberAt(at + 42, 4),
                           .packed = NumberAt(at + 20, 4),
                           .method = NumberAt(at + 10, 2),
                           .crc = NumberAt(at + 16, 4)});
    at = next;
  }
}

std::string ZipArchive::Read(std::string_view name, std::size_t most) const {
  const auto found = entries_.find(name);
  if (found == entries_.end()) {
    throw InputError("has no part " + QuotedName(name));
  }
  const Entry& entry = found->second;
  constexpr std::size_t kFixed = 30;
  const std::size_t begin = entry.offset + kFixed +
                            NumberAt(entry.offset + 26, 2) +
                            NumberAt(entry.offset + 28, 2);
  if (begin > bytes_.size() || entry.packed > bytes_.size() - begin) {
    ThrowDamaged();
  }
  constexpr std::uint32_t kStored = 0;
  constexpr std::uint32_t kDeflated = 8;
  const std::string_view packed = bytes_.substr(begin, entry.packed);
  if (entry.method != kStored && entry.method != kDeflated) ThrowDamaged();
  std::string content =
      entry.method == kStored ? std::string(packed) : Inflate(packed, most);
  if (Crc32(content) != entry.crc) ThrowDamaged();
  return content;
}

// Little-endian.
std::uint32_t ZipArchive::NumberAt(std::size_t offset,
                                   std::size_t bytes) const {
  if (offset > bytes_.size() || bytes > bytes_.size() - offset) ThrowDamaged();
  std::uint32_t number = 0;
  for (std::size_t i = bytes; i > 0; --i) {
    number =
        (number << 8U) | static_cast<unsigned char>(bytes_[offset + i - 1]);
  }
  return number;
}

// The last record, which a comment of any content may follow.
std::size_t ZipArchive::FindDirectory() const {
  constexpr std::size_t kFixed = 22;
  const std::size_t at = bytes_.rfind(kEnd);
  if (at == std::string_view::npos || bytes_.size() - at < kFixed) {
    ThrowDamaged();
  }
  return at;
}

}  // namespace errmap::data
