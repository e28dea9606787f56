#include "data/tables/text/zip_archive.h"

#include <array>

#include <minizip/unzip.h>

#include "data/input_error.h"
#include "data/text.h"

namespace errmap::data {
namespace {

[[noreturn]] void ThrowDamaged() {
  throw InputError(
      "is a spreadsheet or an archive that is damaged; save it again");
}

// minizip reads through the functions of <cstdio>; the "file" is a text here.
voidpf OpenText(voidpf /*opaque*/, const void* text, int /*mode*/) {
  const auto& bytes = *static_cast<const std::string_view*>(text);
  return fmemopen(const_cast<char*>(bytes.data()), bytes.size(), "rb");
}

}  // namespace

bool IsZip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

ZipArchive::ZipArchive(std::string_view bytes) : file_(nullptr, &unzClose) {
  zlib_filefunc64_def functions{};
  fill_fopen64_filefunc(&functions);
  functions.zopen64_file = &OpenText;
  file_.reset(unzOpen2_64(&bytes, &functions));
  if (file_ == nullptr) ThrowDamaged();
}

bool ZipArchive::Has(const std::string& name) const {
  constexpr int kByCase = 1;
  return unzLocateFile(file_.get(), name.c_str(), kByCase) == UNZ_OK;
}

std::string ZipArchive::Read(const std::string& name, std::size_t most) const {
  if (!Has(name)) throw InputError("has no part " + QuotedName(name));
  unz_file_info64 info{};
  unzGetCurrentFileInfo64(
      file_.get(), &info, nullptr, 0, nullptr, 0, nullptr, 0);
  constexpr unsigned kEncrypted = 1;
  if ((info.flag & kEncrypted) != 0) {
    throw InputError("is protected by a password; save it without");
  }
  if (unzOpenCurrentFile(file_.get()) != UNZ_OK) ThrowDamaged();
  std::string content;
  std::array<char, 1U << 16U> buffer{};
  int count = 1;
  while (count > 0 && content.size() <= most) {
    count = unzReadCurrentFile(file_.get(), buffer.data(), buffer.size());
    if (count > 0) content.append(buffer.data(), static_cast<unsigned>(count));
  }
  const int closed = unzCloseCurrentFile(file_.get());  // compares the sums
  if (content.size() > most) throw InputError("is too long when unpacked");
  if (count < 0 || closed != UNZ_OK) ThrowDamaged();
  return content;
}

}  // namespace errmap::data
