#pragma once

#include <string>

namespace errmap::data {

/// Returns a path as reports, maps and journals show it. An absolute path is
/// reduced to the file's name, since folders may name users and customers.
std::string ShownPath(const std::string& path);

/// From now on, shows paths as given. Call it before any other function, if the
/// user asked for it.
void KeepPaths();

}  // namespace errmap::data
