#include "models/version.h"

namespace errmap::models {

const char* Version() { return ERRMAP_VERSION; }

}  // namespace errmap::models
