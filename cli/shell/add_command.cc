#include "cli/shell/add_command.h"

#include <CLI/CLI.hpp>

namespace errmap::cli {

CLI::App* AddCommand(CLI::App* app,
                     const std::string& name,
                     const std::string& description) {
  return app->add_subcommand(name, description);
}

}  // namespace errmap::cli
