#pragma once

#include <string>

#include "models/error_model.h"

namespace CLI {
class App;
}

namespace errmap::cli {

/// Adds --every: the time between the rows that a map's memory counts.
void AddEveryOption(CLI::App* command, std::string* every);

/// Loads the map of a file. If `every` is given, a map that counts rows becomes
/// one that counts seconds, and its name says so. Throws UsageError if `every`
/// is not an interval or the map counts no rows; otherwise throws as LoadMap.
models::FittedModel LoadForControl(const std::string& file,
                                   const std::string& every,
                                   bool quiet);

}  // namespace errmap::cli
