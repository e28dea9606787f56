#pragma once

#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace errmap::cli {

/// Adds a command to the application. Made in one place, since whatever makes a
/// CLI::App compiles nearly all of CLI11 anew.
CLI::App* AddCommand(CLI::App* app,
                     const std::string& name,
                     const std::string& description);

}  // namespace errmap::cli
