#pragma once

#include <string>

namespace errmap::data {

/// Whether a symbolic link stands at the path.
bool IsLink(const std::string& path);

/// Whether the folder that holds the path's last part belongs to this user, so
/// that a link there is their own.
bool IsInOwnFolder(const std::string& path);

/// Throws std::system_error where a link at the path stands in the folder of
/// another user: it may have been laid there for what is about to be written.
void RequireOwnLink(const std::string& path);

/// Takes away a link at the path, before a file is opened there (O_NOFOLLOW);
/// throws as RequireOwnLink, unless `forced`.
void RemoveLink(const std::string& path, bool forced = false);

}  // namespace errmap::data
