#pragma once

#include <algorithm>
#include <string>

namespace errmap {

/// Without line ends: what is said, wherever lines are broken.
inline std::string OneLine(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace errmap
