#pragma once

#include <string>

namespace errmap::data {

/// True if there is a symbolic link at the path.
bool IsLink(const std::string& path);

/// True if the folder of the path belongs to this user, so that a link there
/// can be trusted.
bool IsInOwnFolder(const std::string& path);

/// Throws std::system_error if there is a link at the path in another user's
/// folder. Such a link may be a trap for the file about to be written.
void RequireOwnLink(const std::string& path);

/// Removes a link at the path before a file is opened there (O_NOFOLLOW).
/// Throws as RequireOwnLink, unless `forced`.
void RemoveLink(const std::string& path, bool forced = false);

}  // namespace errmap::data
