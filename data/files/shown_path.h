#pragma once

#include <string>

namespace errmap::data {

/// A path as reports, maps and journals have it: of an absolute one the file's
/// name only, since its folders tell of users and customers.
std::string ShownPath(const std::string& path);

/// From now on paths are written as they were given: for a program whose user
/// asked for it, before all else.
void KeepPaths();

}  // namespace errmap::data
