#pragma once

#include <string_view>
#include <vector>

namespace errmap::data {

/// A file of data/sets/nist_strd, as read by the build.
struct StrdText {
  std::string_view name;
  std::string_view text;
};

/// Returns all files by name. CMake generates the source from them, so that the
/// program needs no data folder.
std::vector<StrdText> StrdTexts();

}  // namespace errmap::data
