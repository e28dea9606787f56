#pragma once

#include <string>

#include "cli/shell/command_reference.h"

namespace errmap::cli {

/// The page Reference of the manual in Markdown: every command with its
/// options, models with theirs, hold-outs, exit statuses, columns' names, as
/// the program itself has them.
std::string ReferencePage(const ProgramReference& program);

}  // namespace errmap::cli
