#pragma once

#include <string>

namespace errmap::data {

/// Whether both paths lead, links followed, to one regular file that exists: by
/// device and inode, so hard links and /dev/stdin are seen through.
bool IsSameFile(const std::string& a, const std::string& b);

}  // namespace errmap::data
