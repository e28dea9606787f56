#include <vector>

#include "cli/commands/data_arguments.h"
#include "cli/report/table.h"
#include "cli/shell/command_options.h"

namespace errmap::cli {
namespace {

void AddFormats(CLI::App* command,
                const std::string& words,
                const std::vector<std::string>& formats,
                std::string* format) {
  AddOption(command, "--format", *format)
      .About(words)
      .OneOf(formats)
      .ShowDefault()
      .Under(kOutputOptions);
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
