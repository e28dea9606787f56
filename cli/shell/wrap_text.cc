#include "cli/shell/wrap_text.h"

namespace errmap::cli {

std::string WrapText(const std::string& text, std::size_t width) {
  std::string wrapped;
  std::size_t column = 0;
  std::size_t begin = 0;
  while (begin < text.size()) {
    std::size_t end = text.find(' ', begin);
    if (end == std::string::npos) end = text.size();
    const std::size_t length = end - begin;
    if (column > 0 && column + 1 + length > width) {
      wrapped += '\n';
      column = 0;
    } else if (column > 0) {
      wrapped += ' ';
      ++column;
    }
    wrapped.append(text, begin, length);
    column += length;
    begin = end + 1;
  }
  return wrapped;
}

}  // namespace errmap::cli
