#include "data/sha256.h"

#include <array>
#include <new>
#include <stdexcept>

#include <openssl/crypto.h>
#include <openssl/err.h>
#include <openssl/evp.h>

namespace errmap::data {
namespace {

void Require(bool done) {
  if (done) return;
  // What begins no digest for want of memory says no more than that.
  const int reason = ERR_GET_REASON(ERR_peek_last_error());
  if (reason == ERR_R_MALLOC_FAILURE || reason == EVP_R_INITIALIZATION_ERROR) {
    throw std::bad_alloc();
  }
  throw std::runtime_error("SHA-256 is not available in libcrypto");
}

}  // namespace

void Sha256Stream::Free::operator()(evp_md_ctx_st* context) const {
  EVP_MD_CTX_free(context);
}

Sha256Stream::Sha256Stream() : context_(EVP_MD_CTX_new()) {
  if (context_ == nullptr) throw std::bad_alloc();
  Require(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
}

// Without a name the context keeps its algorithm, which saves a look-up.
void Sha256Stream::Begin() {
  Require(EVP_DigestInit_ex(context_.get(), nullptr, nullptr) == 1);
}

void Sha256Stream::Add(std::string_view bytes) {
  Require(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1);
}

std::string Sha256Stream::Finish() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  Require(EVP_DigestFinal_ex(context_.get(), digest.data(), &length) == 1);
  Begin();
  return {digest.begin(), digest.begin() + length};
}

std::string Hexadecimal(std::string_view bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  constexpr unsigned kDigitBits = 4;
  constexpr unsigned kLowDigit = 0xf;
  std::string text;
  text.reserve(2 * bytes.size());
  for (const char byte : bytes) {
    const auto value = static_cast<unsigned char>(byte);
    text += kDigits[value >> kDigitBits];
    text += kDigits[value & kLowDigit];
  }
  return text;
}

std::string Sha256(std::string_view content) {
  Sha256Stream stream;
  stream.Add(content);
  return Hexadecimal(stream.Finish());
}

std::string OpenSslVersion() {
  return OpenSSL_version(OPENSSL_FULL_VERSION_STRING);
}

}  // namespace errmap::data
