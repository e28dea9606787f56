#pragma once

#include <string>

#include "models/error_model.h"

namespace CLI {
class App;
}

namespace errmap::cli {

/// --every: how often a row came of those that a map's memory counts.
void AddEveryOption(CLI::App* command, std::string* every);

/// The map of a file; one that counts rows in seconds, where `every` is given,
/// which its name then says.
/// Throws UsageError where it is no interval or the map counts no rows, else
/// as LoadMap.
models::FittedModel LoadForControl(const std::string& file,
                                   const std::string& every,
                                   bool quiet);

}  // namespace errmap::cli
