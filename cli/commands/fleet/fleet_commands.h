#pragma once

#include "cli/command.h"

namespace errmap::cli {

/// As those of command.h: what is done with stores of many components.
void AddMergeCommand(CLI::App* app, Run* run);
void AddSubmitCommand(CLI::App* app, Run* run);
void AddDeployCommand(CLI::App* app, Run* run);
void AddWatchCommand(CLI::App* app, Run* run);

}  // namespace errmap::cli
