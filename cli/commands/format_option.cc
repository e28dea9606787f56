#include "cli/commands/format_option.h"

#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/table.h"

namespace errmap::cli {
namespace {

void AddFormats(CLI::App* command,
                const std::string& words,
                const std::vector<std::string>& formats,
                std::string* format) {
  command->add_option("--format", *format, words)
      ->check(CLI::IsMember(formats))
      ->type_name(fmt::format("{}", fmt::join(formats, "|")))
      ->capture_default_str();
}

}  // namespace

void AddFormatOption(CLI::App* command, std::string* format) {
  AddFormats(command, "table or json", {"table", "json"}, format);
}

void AddTableFormatOption(CLI::App* command,
                          const std::string& words,
                          std::string* format) {
  std::vector<std::string> formats{"table", "json"};
  for (const report::TableFormat& known : report::TableFormats()) {
    formats.emplace_back(known.name);
  }
  AddFormats(command, words, formats, format);
}

}  // namespace errmap::cli
