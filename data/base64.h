#pragma once

#include <string>
#include <string_view>

namespace errmap::data {

/// RFC 4648, section 4: letters, digits, + and /, filled up with =.
std::string ToBase64(std::string_view bytes);

/// What ToBase64 wrote. Throws std::invalid_argument where it is no such text.
std::string FromBase64(std::string_view text);

}  // namespace errmap::data
