#include "data/files/same_file.h"

#include <sys/stat.h>

#include "data/files/sheet_path.h"

namespace errmap::data {

bool IsSameFile(const std::string& a, const std::string& b) {
  struct stat of_a {};
  struct stat of_b {};
  return stat(SplitSheetPath(a).file.c_str(), &of_a) == 0 &&
         stat(SplitSheetPath(b).file.c_str(), &of_b) == 0 &&
         S_ISREG(of_a.st_mode) && of_a.st_dev == of_b.st_dev &&
         of_a.st_ino == of_b.st_ino;
}

}  // namespace errmap::data
