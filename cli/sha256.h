#pragma once

#include <string>
#include <string_view>

namespace errmap::cli {

/// SHA-256 of `content` in lower-case hexadecimal.
std::string Sha256(std::string_view content);

}  // namespace errmap::cli
