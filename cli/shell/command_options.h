#pragma once

#include <algorithm>
#include <concepts>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command.h"
#include "cli/shell/command_reference.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

// Declares commands and their arguments. Only this folder and
// cli/application.cc include CLI11's headers: these take a compiler three
// seconds, used or not.

namespace errmap::cli {

CLI::App* AddSubcommand(CLI::App* app,
                        const std::string& name,
                        const std::string& about);
void OnRun(CLI::App* command, std::function<void()> act);

/// A command of `app` that reads Arguments. It is used like its parser where
/// options are added; `command->file` is an argument, which lives as long as
/// the parser does.
template <typename Arguments>
class Command {
 public:
  Command(CLI::App* app,
          Run* run,
          const std::string& name,
          const std::string& about)
      : app_(AddSubcommand(app, name, about)), run_(run) {}

  CLI::App* app() const { return app_; }
  operator CLI::App*() const { return app_; }  // NOLINT: stands for it
  Arguments* operator->() const { return arguments_.get(); }
  Arguments& operator*() const { return *arguments_; }

  /// Sets the action of the command: act(arguments), or act(arguments, command
  /// line), the latter as in Run. It returns the exit status.
  template <typename Act>
  void Runs(const Act& act) const {
    OnRun(app_, [act, arguments = arguments_, run = run_] {
      if constexpr (std::invocable<const Act&, Arguments&>) {
        run->status = act(*arguments);
      } else {
        run->status = act(*arguments, run->command_line);
      }
    });
  }

 private:
  CLI::App* app_;
  Run* run_;
  std::shared_ptr<Arguments> arguments_ = std::make_shared<Arguments>();
};

/// An option or a positional argument of a command, valid as long as the
/// command is. Each call sets one property.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  /// Explains it in help: a sentence, and further lines for help --all.
  const Option& About(const std::string& text) const;
  const Option& Required(bool required = true) const;
  /// Sets the placeholder of its value in help: "FILE.csv".
  const Option& Value(const std::string& name) const;
  /// Shows a default in help: this text, or with ShowDefault the variable's
  /// current value.
  const Option& Default(const std::string& text) const;
  const Option& ShowDefault() const;
  /// Accepts whole numbers from `low` to `high`.
  const Option& Range(long long low, long long high) const;
  /// `complaint` returns the fault of a text; "" if it is valid.
  const Option& Check(
      std::function<std::string(const std::string&)> complaint) const;
  const Option& Positive() const;
  const Option& NotNegative() const;
  /// Accepts only one of `words`, and says so in help.
  const Option& OneOf(const std::vector<std::string>& words) const;
  /// Accepts "a,b" as two values.
  const Option& SeparatedBy(char delimiter) const;
  /// Accepts repetition, with one value each time.
  const Option& OneAtATime() const;
  /// Shows it only in help COMMAND --all.
  const Option& Seldom() const;
  /// Shows it under this heading.
  const Option& Under(std::string_view heading) const;

 private:
  CLI::Option* option_;
};

/// `usage`: names and the value's placeholder in help, "-o,--output FILE.csv";
/// for a positional argument its word instead of the names. T: a whole number,
/// double, std::string, an optional of these two, or a vector of int, long or
/// std::string. The value must outlive the parse.
template <typename T>
Option AddOption(CLI::App* command, const std::string& usage, T& value);
Option AddOption(CLI::App* command,
                 const std::string& usage,
                 const std::function<void(const std::string&)>& take);
Option AddOption(
    CLI::App* command,
    const std::string& usage,
    const std::function<void(const std::vector<std::string>&)>& take);

/// Adds an option with one word for each value, as ToString names it.
template <typename Value>
void AddChoice(CLI::App* command,
               const std::string& name,
               const std::string& about,
               const std::vector<Value>& values,
               Value* chosen) {
  std::vector<std::string> words;
  for (const Value value : values) words.emplace_back(ToString(value));
  const std::function<void(const std::string&)> take =
      [words, values, chosen](const std::string& word) {
        *chosen = values[std::ranges::find(words, word) - words.begin()];
      };
  AddOption(command, name, take)
      .About(about)
      .OneOf(words)
      .Default(std::string(ToString(*chosen)));
}

Option AddFlag(CLI::App* command, const std::string& name, bool& value);
Option AddFlag(CLI::App* command,
               const std::string& name,
               std::function<void()> act);

/// Returns an existing option.
Option FindOption(CLI::App* command, const std::string& name);

/// Shows existing options only in help COMMAND --all.
void MarkSeldom(CLI::App* command, const std::vector<const char*>& names);

/// Sets the last text of a command's help.
void SetFooter(CLI::App* command, const std::string& text);

/// Returns the names of the options among the parsed words.
std::set<std::string> GivenOptions(const CLI::App& command);

/// Parses words with the options that `add` adds; returns the names of the
/// given ones. Throws UsageError.
std::set<std::string> ParseWords(std::vector<std::string> words,
                                 const std::function<void(CLI::App*)>& add);

}  // namespace errmap::cli
