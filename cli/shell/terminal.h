#pragma once

#include <string_view>

#include "cli/report/screen.h"

namespace errmap::cli {

/// What standard output can show; 80 columns where it is no terminal. COLUMNS,
/// LINES and NO_COLOR of the environment come first.
report::Terminal OutputTerminal();

/// PrintResult, the strong lines bold where standard output has colours.
void PrintScreen(const report::Screen& screen);

/// PrintResult of text that is read; where standard output is a terminal, or
/// COLUMNS says how wide it is, no line is wider.
void PrintFitted(std::string_view text);

}  // namespace errmap::cli
