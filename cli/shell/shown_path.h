#pragma once

#include <string>

namespace errmap::cli {

/// From now on paths are written as they were given (--keep-paths).
void KeepPaths();

/// A path as reports, maps and journals have it: of an absolute one the file's
/// name only, since its folders tell of users and customers.
std::string ShownPath(const std::string& path);

/// The same of a word of the command line, in which a path may stand after '='
/// or ':' (--out=/home/me/study, file:/home/me/map.json) and in lists.
std::string ShownWord(const std::string& word);

}  // namespace errmap::cli
