#pragma once

#include <string_view>
#include <vector>

namespace errmap::data {

/// A file of data/sets/nist_strd as the build found it.
struct StrdText {
  std::string_view name;
  std::string_view text;
};

/// All of them by name. Defined in a source that CMake writes from the files,
/// so that the program needs no data folder where it runs.
std::vector<StrdText> StrdTexts();

}  // namespace errmap::data
