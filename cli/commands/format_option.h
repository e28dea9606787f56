#pragma once

#include <string>

namespace CLI {
class App;
}

namespace errmap::cli {

/// --format table|json, as commands without more formats have it.
void AddFormatOption(CLI::App* command, std::string* format);

/// --format table|json and the formats of report/table.h; `words` say what is
/// printed.
void AddTableFormatOption(CLI::App* command,
                          const std::string& words,
                          std::string* format);

}  // namespace errmap::cli
