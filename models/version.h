#pragma once

namespace errmap::models {

/// Version of errmap, written into every output.
const char* Version();

}  // namespace errmap::models
