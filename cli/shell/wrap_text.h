#pragma once

#include <string>

namespace errmap::cli {

/// `text` in lines of at most `width` columns, broken at blanks; a longer word
/// has a line of its own.
std::string WrapText(const std::string& text, std::size_t width);

}  // namespace errmap::cli
