#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::report {

/// What text is shown on.
struct Terminal {
  std::size_t columns = 80;
  std::size_t rows = 0;  // 0: no end, as of a pipe or a file
  bool colour = false;

  /// Of text that is read: longer lines are hard to follow.
  std::size_t text_columns() const;
};

/// Text with lines that stand out.
struct Screen {
  std::string text;
  std::vector<std::size_t> strong;  // numbers of lines, from 0

  void Add(std::string_view more, bool is_strong = false);
};

}  // namespace errmap::report
