#pragma once

#include <string>
#include <string_view>

#include "cli/report/screen.h"

namespace errmap::cli {

/// What standard output can show; 80 columns where it is no terminal. COLUMNS,
/// LINES and NO_COLOR of the environment come first.
report::Terminal OutputTerminal();

/// PrintResult, the strong lines bold where standard output has colours.
void PrintScreen(const report::Screen& screen);

/// A message with a line feed; where standard error is a terminal, broken at
/// blanks to fit it.
std::string MessageLines(std::string_view line);

/// PrintResult of text that is read: no line is wider than OutputTerminal().
void PrintFitted(std::string_view text);

}  // namespace errmap::cli
