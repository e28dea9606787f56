#pragma once

namespace errmap::models {

/// Returns the version of errmap, which every output contains.
const char* Version();

}  // namespace errmap::models
