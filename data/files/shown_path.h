#pragma once

#include <string>

namespace errmap::data {

/// Returns a path as reports, maps and journals show it. Of an absolute path it
/// is the file's name only, since folders may name users and customers.
std::string ShownPath(const std::string& path);

/// Shows paths as given from now on. Call it before anything else, if the user
/// asked for it.
void KeepPaths();

}  // namespace errmap::data
