#pragma once

#include <string>

#include "models/error_model.h"

namespace CLI {
class App;
}

namespace errmap::cli {

/// Adds --every: the time between rows, for maps whose memory counts rows.
void AddEveryOption(CLI::App* command, std::string* every);

/// Loads the map of a file. If `every` is given, converts a map that counts
/// rows to one that counts seconds, and adds this to its name. Throws
/// UsageError if `every` is not an interval or the map counts no rows;
/// otherwise throws as LoadMap.
models::FittedModel LoadForControl(const std::string& file,
                                   const std::string& every,
                                   bool quiet);

}  // namespace errmap::cli
