#pragma once

#include <string>

#include "cli/shell/command_reference.h"

namespace errmap::cli {

/// errmap(1) in man(7) macros: every command with its options, and every model
/// with the options it takes.
std::string ManPage(const ProgramReference& program);

}  // namespace errmap::cli
