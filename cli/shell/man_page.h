#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/shell/command_reference.h"

namespace errmap::cli {

/// errmap(1) in man(7) macros: every command with its options, and every model
/// with the options it takes.
std::string ManPage(const ProgramReference& program);

/// What each exit status says.
const std::vector<std::pair<int, std::string>>& ExitStatusWords();

}  // namespace errmap::cli
