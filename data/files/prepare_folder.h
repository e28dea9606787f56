#pragma once

#include <string>

namespace errmap::data {

/// Creates the folder `path` (and its parents) if it is missing, and makes sure
/// that files can be written there. Throws std::system_error.
void PrepareFolder(const std::string& path);

}  // namespace errmap::data
