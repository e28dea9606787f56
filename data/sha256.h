#pragma once

#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;  // OpenSSL's

namespace errmap::data {

/// Computes SHA-256 (FIPS 180-4) from bytes in pieces.
class Sha256Stream {
 public:
  Sha256Stream();

  void Add(std::string_view bytes);
  /// Returns the 32 bytes of the digest and starts again.
  std::string Finish();

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const;
  };
  void Begin();

  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

/// Two lower-case digits per byte.
std::string Hexadecimal(std::string_view bytes);

/// SHA-256 of `content` in lower-case hexadecimal.
std::string Sha256(std::string_view content);

/// Version of the library that computes it.
std::string OpenSslVersion();

}  // namespace errmap::data
