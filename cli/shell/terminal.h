#pragma once

#include <string>
#include <string_view>

#include "cli/report/screen.h"

namespace errmap::cli {

/// Returns what standard output can show; 80 columns if it is not a terminal.
/// The environment's COLUMNS, LINES and NO_COLOR take precedence.
report::Terminal OutputTerminal();

/// PrintResult with bold strong lines if standard output has colours.
void PrintScreen(const report::Screen& screen);

/// Returns a message with a line feed. If standard error is a terminal, breaks
/// it at blanks to fit.
std::string MessageLines(std::string_view line);

/// PrintResult of running text, in lines no wider than OutputTerminal().
void PrintFitted(std::string_view text);

}  // namespace errmap::cli
