#pragma once

#include <cstddef>
#include <string>

#include "cli/shell/command_reference.h"

namespace errmap::cli {

/// All commands under what each serves, a line each.
std::string ProgramHelp(const ProgramReference& program, std::size_t width);

/// Which options a command's help names.
enum class HelpOptions { kUsual, kAll };

/// How a command is called, its options, an example.
std::string CommandHelp(const CommandReference& command,
                        HelpOptions options,
                        std::size_t width);

/// For who calls the program and nothing else: what to begin with.
std::string FirstSteps();

/// "FILE.csv --model SPEC [options]": what `command` must have.
std::string UsageOf(const CommandReference& command);

}  // namespace errmap::cli
