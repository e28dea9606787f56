#include "data/base64.h"

#include <algorithm>
#include <stdexcept>

#include <openssl/evp.h>

namespace errmap::data {
namespace {

constexpr std::size_t kBytes = 3;  // become so many letters:
constexpr std::size_t kSextets = 4;
// libcrypto counts in int, and texts may be longer.
constexpr std::size_t kMostGroups = std::size_t{1} << 20U;

const unsigned char* Unsigned(std::string_view text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

}  // namespace

std::string ToBase64(std::string_view bytes) {
  std::string text;
  // It ends with a 0.
  std::string piece(
      std::min(kMostGroups, bytes.size() / kBytes + 1) * kSextets + 1, '\0');
  while (!bytes.empty()) {
    const std::string_view some = bytes.substr(0, kMostGroups * kBytes);
    const int length =
        EVP_EncodeBlock(reinterpret_cast<unsigned char*>(piece.data()),
                        Unsigned(some),
                        static_cast<int>(some.size()));
    text.append(piece, 0, static_cast<std::size_t>(length));
    bytes.remove_prefix(some.size());
  }
  return text;
}

std::string FromBase64(std::string_view text) {
  const std::size_t end = text.find_last_not_of('=') + 1;
  const std::size_t fill = text.size() - end;
  const auto is_letter = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           (c >= '0' && c <= '9') || c == '+' || c == '/';
  };
  // libcrypto passes over blanks and what follows them.
  if (text.size() % kSextets != 0 || fill >= kBytes ||
      !std::ranges::all_of(text.substr(0, end), is_letter)) {
    throw std::invalid_argument("no base64");
  }
  std::string bytes;
  std::string piece(std::min(kMostGroups * kBytes, text.size()), '\0');
  while (!text.empty()) {
    const std::string_view some = text.substr(0, kMostGroups * kSextets);
    const int length =
        EVP_DecodeBlock(reinterpret_cast<unsigned char*>(piece.data()),
                        Unsigned(some),
                        static_cast<int>(some.size()));
    if (length < 0) throw std::invalid_argument("no base64");
    bytes.append(piece, 0, static_cast<std::size_t>(length));
    text.remove_prefix(some.size());
  }
  bytes.resize(bytes.size() - fill);
  return bytes;
}

}  // namespace errmap::data
