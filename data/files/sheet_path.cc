#include "data/files/sheet_path.h"

#include <array>
#include <string_view>

#include <sys/stat.h>

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

bool IsSameFile(const std::string& a, const std::string& b) {
  struct stat of_a {};
  struct stat of_b {};
  return stat(SplitSheetPath(a).file.c_str(), &of_a) == 0 &&
         stat(SplitSheetPath(b).file.c_str(), &of_b) == 0 &&
         S_ISREG(of_a.st_mode) && of_a.st_dev == of_b.st_dev &&
         of_a.st_ino == of_b.st_ino;
}

}  // namespace errmap::data
