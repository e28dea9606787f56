#include "data/files/sheet_path.h"

#include <array>
#include <string_view>

#include "data/text.h"

namespace errmap::data {

SheetPath SplitSheetPath(const std::string& path) {
  constexpr auto kEndings = std::to_array<std::string_view>({".xlsx", ".xlsm"});
  // No sheet's name may hold a colon.
  const std::size_t colon = path.rfind(':');
  const std::string file = path.substr(0, colon);
  for (const std::string_view ending : kEndings) {
    if (colon != path.npos && EndsWithIgnoringCase(file, ending)) {
      return {file, path.substr(colon + 1)};
    }
  }
  return {path, ""};
}

}  // namespace errmap::data
