#pragma once

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

  /// Width of running text; longer lines are hard to read.
  std::size_t text_columns() const;
};

/// Text with emphasised lines.
struct Screen {
  std::string text;
  std::vector<std::size_t> strong;  // line numbers, from 0

  void Add(std::string_view more, bool is_strong = false);
};

}  // namespace errmap::report
