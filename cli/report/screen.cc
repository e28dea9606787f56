#include "cli/report/screen.h"

#include <algorithm>

namespace errmap::report {

std::size_t Terminal::text_columns() const {
  constexpr std::size_t kMost = 100;
  return std::min(columns, kMost);
}

void Screen::Add(std::string_view more, bool is_strong) {
  if (is_strong) {
    const auto first = static_cast<std::size_t>(std::ranges::count(text, '\n'));
    const auto lines = static_cast<std::size_t>(std::ranges::count(more, '\n'));
    for (std::size_t i = 0; i < std::max<std::size_t>(lines, 1); ++i) {
      strong.push_back(first + i);
    }
  }
  text += more;
}

}  // namespace errmap::report
