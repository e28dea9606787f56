#include "cli/json_blocks.h"

namespace errmap::cli {

std::string DumpJson(const Json& document) {
  constexpr int kIndent = 1;
  // Names from files may hold any bytes: what is no UTF-8 is replaced.
  return document.dump(kIndent, ' ', false, Json::error_handler_t::replace) +
         "\n";
}

}  // namespace errmap::cli
