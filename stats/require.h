#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace errmap::stats {

/// Throws std::invalid_argument, "WHAT, found FOUND", unless it `holds`.
template <typename Number>
void Require(bool holds, std::string_view what, Number found) {
  if (holds) return;
  throw std::invalid_argument(std::string(what) + ", found " +
                              std::to_string(found));
}

}  // namespace errmap::stats
