#pragma once

#include <string>

namespace CLI {
class App;
}

namespace errmap::cli {

/// --format table|json, as commands without more formats have it.
void AddFormatOption(CLI::App* command, std::string* format);

}  // namespace errmap::cli
