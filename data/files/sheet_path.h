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

}  // namespace errmap::data
