#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::report {

/// The medium on which text is shown.
struct Terminal {
  std::size_t columns = 80;
  std::size_t rows = 0;  // 0: no limit, as for a pipe or a file
  bool colour = false;

  /// Width of running text, at most 100: longer lines are hard to read.
  std::size_t text_columns() const {
    return std::min<std::size_t>(columns, 100);
  }
};

/// Text with emphasised lines.
struct Screen {
  std::string text;
  std::vector<std::size_t> strong;  // line numbers, from 0

  void Add(std::string_view more, bool is_strong = false) {
    const auto lines_of = [](std::string_view of) {
      return static_cast<std::size_t>(std::ranges::count(of, '\n'));
    };
    for (std::size_t i = 0;
         is_strong && i < std::max<std::size_t>(lines_of(more), 1);
         ++i) {
      strong.push_back(lines_of(text) + i);
    }
    text += more;
  }
};

}  // namespace errmap::report
