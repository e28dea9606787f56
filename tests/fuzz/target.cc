// libFuzzer's door to the readers: ERRMAP_FUZZ=csv fuzz_readers CORPUS...

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/fuzz/readers.h"

namespace {

const errmap::fuzz::Reader& Chosen() {
  const char* const name = std::getenv("ERRMAP_FUZZ");
  for (const errmap::fuzz::Reader& reader : errmap::fuzz::Readers()) {
    if (name != nullptr && std::string_view(reader.name) == name) {
      return reader;
    }
  }
  std::fprintf(stderr, "ERRMAP_FUZZ must be one of:");
  for (const errmap::fuzz::Reader& reader : errmap::fuzz::Readers()) {
    std::fprintf(stderr, " %s", reader.name);
  }
  std::fprintf(stderr, "\n");
  std::_Exit(2);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  static const errmap::fuzz::Reader& reader = Chosen();
  reader.read({reinterpret_cast<const char*>(data), size});
  return 0;
}
