#pragma once

#include <string>

namespace errmap::data {

/// True if both paths lead to the same existing regular file. Compares device
/// and inode, so it follows links and recognises hard links and /dev/stdin.
bool IsSameFile(const std::string& a, const std::string& b);

}  // namespace errmap::data
