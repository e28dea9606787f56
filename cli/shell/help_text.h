#pragma once

#include <cstddef>
#include <string>

#include "cli/shell/command_reference.h"

namespace errmap::cli {

/// Returns all commands, one line each, grouped by purpose.
std::string ProgramHelp(const ProgramReference& program, std::size_t width);

/// Which options a command's help shows.
enum class HelpOptions { kUsual, kAll };

/// Returns a command's usage, its options and an example.
std::string CommandHelp(const CommandReference& command,
                        HelpOptions options,
                        std::size_t width);

/// Returns an option's first statement, with kAll also the others, and default.
std::string Explained(const OptionReference& option, HelpOptions options);

/// Returns the first steps, for a call without arguments.
std::string FirstSteps();

/// Returns "FILE.csv --model SPEC [options]": what `command` requires.
std::string UsageOf(const CommandReference& command);

}  // namespace errmap::cli
