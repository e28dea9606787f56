#include "cli/commands/format_option.h"

#include <CLI/CLI.hpp>

namespace errmap::cli {

void AddFormatOption(CLI::App* command, std::string* format) {
  command->add_option("--format", *format, "table or json")
      ->check(CLI::IsMember({"table", "json"}))
      ->type_name("table|json")
      ->capture_default_str();
}

}  // namespace errmap::cli
