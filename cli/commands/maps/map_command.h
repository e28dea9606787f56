#pragma once

#include <string>
#include <vector>

#include "cli/json_blocks.h"
#include "models/error_model.h"

namespace CLI {
class App;
}

namespace errmap::cli {

/// Adds MODEL, a model file that a command must be given.
void AddModelArgument(CLI::App* command, std::string* model);

/// What the JSON of a map that is judged on measurements begins with: schema,
/// model, file, target and unit.
Json MapAnswerJson(const char* schema,
                   const models::FittedModel& fitted,
                   const std::vector<std::string>& files);

}  // namespace errmap::cli
