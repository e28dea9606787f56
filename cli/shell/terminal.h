#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::cli {

/// What standard output can show.
struct Terminal {
  std::size_t columns = 80;
  std::size_t rows = 0;  // 0: no end, as of a pipe or a file
  bool colour = false;

  /// Of text that is read: longer lines are hard to follow.
  std::size_t text_columns() const;
};

/// That of standard output; 80 columns where it is no terminal. COLUMNS, LINES
/// and NO_COLOR of the environment come first.
Terminal OutputTerminal();

/// Text with lines that stand out.
struct Screen {
  std::string text;
  std::vector<std::size_t> strong;  // numbers of lines, from 0

  void Add(std::string_view more, bool is_strong = false);
};

/// PrintResult, the strong lines bold where standard output has colours.
void PrintScreen(const Screen& screen);

/// `text` with its lines of more than `width` columns broken at blanks; what
/// goes on stands below what it goes on with, in the second column of a list
/// of options.
std::string FitLines(std::string_view text, std::size_t width);

/// PrintResult of text that is read; where standard output is a terminal, or
/// COLUMNS says how wide it is, no line is wider.
void PrintFitted(std::string_view text);

}  // namespace errmap::cli
