#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace errmap::data {

/// A last line that ends inside a number, because of an incomplete copy or a
/// full disk.
struct CutLine {
  const char* start;   // where the line begins
  std::string number;  // what is left of its last cell
};

/// Looks for a cut line at the end of a table's rows. It has no line end, and
/// its last number has fewer decimals than each of the many numbers above it.
std::optional<CutLine> FindCutLine(std::string_view rows, char delimiter);

}  // namespace errmap::data
