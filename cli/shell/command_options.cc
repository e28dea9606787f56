#include "cli/shell/command_options.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include <CLI/CLI.hpp>

#include "cli/shell/command_reference.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

// "--column" of "--column COL".
std::string NamesOf(const std::string& usage) {
  return usage.substr(0, usage.find(' '));
}

Option WithValue(CLI::Option* option, const std::string& usage) {
  const std::size_t space = usage.find(' ');
  if (space != usage.npos) option->type_name(usage.substr(space + 1));
  return Option(option);
}

}  // namespace

const Option& Option::About(const std::string& text) const {
  option_->description(text);
  return *this;
}

const Option& Option::Required(bool required) const {
  option_->required(required);
  return *this;
}

const Option& Option::Value(const std::string& name) const {
  option_->type_name(name);
  return *this;
}

const Option& Option::Default(const std::string& text) const {
  option_->default_str(text);
  return *this;
}

const Option& Option::ShowDefault() const {
  option_->capture_default_str();
  return *this;
}

const Option& Option::Range(long long low, long long high) const {
  option_->check(CLI::Range(low, high));
  return *this;
}

const Option& Option::Check(
    std::function<std::string(const std::string&)> complaint) const {
  option_->check(std::move(complaint));
  return *this;
}

const Option& Option::Positive() const {
  option_->check(CLI::PositiveNumber);
  return *this;
}

const Option& Option::NotNegative() const {
  option_->check(CLI::NonNegativeNumber);
  return *this;
}

const Option& Option::OneOf(const std::vector<std::string>& words) const {
  option_->check(CLI::IsMember(words));
  option_->type_name(data::JoinWords(words, "|"));
  return *this;
}

const Option& Option::SeparatedBy(char delimiter) const {
  option_->delimiter(delimiter);
  return *this;
}

const Option& Option::OneAtATime() const {
  option_->allow_extra_args(false);
  return *this;
}

const Option& Option::Seldom() const {
  option_->group(std::string(kSeldom) + option_->get_group());
  return *this;
}

const Option& Option::Under(std::string_view heading) const {
  option_->group(std::string(heading));
  return *this;
}

CLI::App* AddSubcommand(CLI::App* app,
                        const std::string& name,
                        const std::string& about) {
  return app->add_subcommand(name, about);
}

void OnRun(CLI::App* command, std::function<void()> act) {
  command->callback(std::move(act));
}

template <typename T>
Option AddOption(CLI::App* command, const std::string& usage, T& value) {
  return WithValue(command->add_option(NamesOf(usage), value), usage);
}

#define ERRMAP_OPTION(...) \
  template Option AddOption(CLI::App*, const std::string&, __VA_ARGS__&)
ERRMAP_OPTION(int);
ERRMAP_OPTION(long);
ERRMAP_OPTION(long long);
ERRMAP_OPTION(std::uint64_t);
ERRMAP_OPTION(double);
ERRMAP_OPTION(std::string);
ERRMAP_OPTION(std::optional<double>);
ERRMAP_OPTION(std::optional<std::string>);
ERRMAP_OPTION(std::vector<int>);
ERRMAP_OPTION(std::vector<long>);
ERRMAP_OPTION(std::vector<std::string>);
#undef ERRMAP_OPTION

Option AddOption(CLI::App* command,
                 const std::string& usage,
                 const std::function<void(const std::string&)>& take) {
  return WithValue(command->add_option_function(NamesOf(usage), take), usage);
}

Option AddOption(
    CLI::App* command,
    const std::string& usage,
    const std::function<void(const std::vector<std::string>&)>& take) {
  return WithValue(command->add_option_function(NamesOf(usage), take), usage);
}

Option AddFlag(CLI::App* command, const std::string& name, bool& value) {
  return Option(command->add_flag(name, value));
}

Option AddFlag(CLI::App* command,
               const std::string& name,
               std::function<void()> act) {
  return Option(command->add_flag_callback(name, std::move(act)));
}

Option FindOption(CLI::App* command, const std::string& name) {
  return Option(command->get_option(name));
}

void MarkSeldom(CLI::App* command, const std::vector<const char*>& names) {
  for (const char* name : names) FindOption(command, name).Seldom();
}

void SetFooter(CLI::App* command, const std::string& text) {
  command->footer(text);
}

std::set<std::string> GivenOptions(const CLI::App& command) {
  std::set<std::string> given;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() > 0) given.insert(option->get_name());
  }
  return given;
}

std::set<std::string> ParseWords(std::vector<std::string> words,
                                 const std::function<void(CLI::App*)>& add) {
  CLI::App command;
  add(&command);
  std::ranges::reverse(words);  // as CLI11 takes them
  try {
    command.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  return GivenOptions(command);
}

}  // namespace errmap::cli
