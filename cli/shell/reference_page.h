#pragma once

#include <string>

#include "cli/shell/command_reference.h"

namespace errmap::cli {

/// Returns the manual's page Reference in Markdown, from the program itself:
/// every command with its options, models with theirs, hold-outs, exit statuses
/// and column names.
std::string ReferencePage(const ProgramReference& program);

}  // namespace errmap::cli
