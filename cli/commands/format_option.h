#pragma once

#include <string>

namespace CLI {
class App;
}

namespace errmap::cli {

/// Adds --format table|json, for commands without more formats.
void AddFormatOption(CLI::App* command, std::string* format);

/// Adds --format with table, json and the formats of report/table.h. `words`
/// explain the option in the help.
void AddTableFormatOption(CLI::App* command,
                          const std::string& words,
                          std::string* format);

}  // namespace errmap::cli
