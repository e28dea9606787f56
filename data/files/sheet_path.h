#pragma once

#include <string>

namespace errmap::data {

/// "book.xlsx" and "Day 2" of "book.xlsx:Day 2"; of any other path all of it
/// and "".
struct SheetPath {
  std::string file;
  std::string sheet;
};

SheetPath SplitSheetPath(const std::string& path);

}  // namespace errmap::data
