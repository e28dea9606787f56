#pragma once

#include <string_view>
#include <vector>

namespace errmap::fuzz {

/// A reader of what users hand to the program. `read` takes any bytes; what it
/// refuses by an exception of its own kind is fine, all else is a finding.
struct Reader {
  const char* name;  // and the folder of its corpus
  void (*read)(std::string_view bytes);
};

const std::vector<Reader>& Readers();

}  // namespace errmap::fuzz
