#include "cli/shell/command_reference.h"

#include <CLI/CLI.hpp>

namespace errmap::cli {
namespace {

// CLI11 appends what it checks: "table|json:{table,json}".
std::string ValueName(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return "";
  const std::string name = option.get_type_name();
  return name.substr(0, name.find(':'));
}

// The a, b of "{a,b}", which is how CLI11 names a check for members.
std::vector<std::string> Choices(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  const std::size_t open = name.find(":{");
  if (open == std::string::npos || !name.ends_with('}')) return {};
  return CLI::detail::split(name.substr(open + 2, name.size() - open - 3), ',');
}

OptionReference DescribeOption(const CLI::Option& option) {
  const std::string& group = option.get_group();
  const bool seldom = group.starts_with(kSeldom);
  OptionReference reference{
      .value = ValueName(option),
      .choices = Choices(option),
      .description = option.get_description(),
      .fallback = option.get_default_str(),
      .required = option.get_required(),
      .repeatable = option.get_items_expected_max() > 1,
      .seldom = seldom,
      .heading = group.substr(seldom ? kSeldom.size() : 0)};
  for (const std::string& name : option.get_snames()) {
    reference.names.push_back("-" + name);
  }
  for (const std::string& name : option.get_lnames()) {
    reference.names.push_back("--" + name);
  }
  if (option.get_positional()) {
    reference.names = {option.get_name(true, false)};
  }
  return reference;
}

CommandReference DescribeCommand(const CLI::App& command,
                                 const std::string& inherited_footer) {
  CommandReference reference{.name = command.get_name(),
                             .purpose = command.get_group(),
                             .description = command.get_description(),
                             .footer = command.get_footer()};
  if (reference.footer == inherited_footer) reference.footer.clear();
  for (const CLI::Option* option : command.get_options(nullptr)) {
    if (option == command.get_help_ptr()) continue;
    if (option->get_group().empty()) continue;  // CLI11's way of hiding it
    (option->get_positional() ? reference.positionals : reference.options)
        .push_back(DescribeOption(*option));
  }
  return reference;
}

}  // namespace

ProgramReference DescribeProgram(const CLI::App& app) {
  ProgramReference program{.description = app.get_description(),
                           .footer = app.get_footer()};
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    if (command->get_group().empty()) continue;
    program.commands.push_back(DescribeCommand(*command, program.footer));
  }
  return program;
}

}  // namespace errmap::cli
