#pragma once

#include <string>

namespace errmap::tests {

/// Root of the source tree, without a slash at its end.
std::string SourceDir();
/// SourceDir()/tests.
std::string TestDir();
/// Path of the built program.
std::string Binary();

}  // namespace errmap::tests
