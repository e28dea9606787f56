#include "tests/places.h"

namespace errmap::tests {

std::string SourceDir() { return ERRMAP_SOURCE_DIR; }
std::string TestDir() { return SourceDir() + "/tests"; }
std::string Binary() { return ERRMAP_BINARY; }

}  // namespace errmap::tests
