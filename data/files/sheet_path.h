#pragma once

#include <string>

namespace errmap::data {

/// Splits "book.xlsx:Day 2" into "book.xlsx" and "Day 2"; any other path into
/// itself and "".
struct SheetPath {
  std::string file;
  std::string sheet;
};

SheetPath SplitSheetPath(const std::string& path);

/// True if both paths lead to the same existing regular file. Compares device
/// and inode, so it follows links and recognises hard links and /dev/stdin.
bool IsSameFile(const std::string& a, const std::string& b);

}  // namespace errmap::data
