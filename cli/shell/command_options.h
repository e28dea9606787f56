#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

// How commands say what they take. In this room and in cli/application.cc alone
// CLI11 is known by its headers: they take a compiler three seconds, used or
// not.

namespace errmap::cli {

/// An option or a positional word of a command, for as long as that lives; each
/// call says one thing more of it.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  const Option& Required(bool required = true) const;
  /// What stands for its value in help: "FILE.csv".
  const Option& Value(const std::string& name) const;
  /// Help shows this default, or what the variable holds now.
  const Option& Default(const std::string& text) const;
  const Option& ShowDefault() const;
  /// Whole numbers from `low` to `high`.
  const Option& Range(long long low, long long high) const;
  /// `complaint` of a text: "" where it will do.
  const Option& Check(
      std::function<std::string(const std::string&)> complaint) const;
  const Option& Positive() const;
  const Option& NotNegative() const;
  /// Its value is one of `words`, and help says so.
  const Option& OneOf(const std::vector<std::string>& words) const;
  /// Takes "a,b" for two values.
  const Option& SeparatedBy(char delimiter) const;
  /// May be repeated, a value each time.
  const Option& OneAtATime() const;
  /// Left to help COMMAND --all.
  const Option& Seldom() const;
  const Option& About(const std::string& text) const;

 private:
  CLI::Option* option_;
};

CLI::App* AddCommand(CLI::App* app,
                     const std::string& name,
                     const std::string& about);

/// `usage`: names and what stands for the value in help, "-o,--output
/// FILE.csv", or the word of a positional in the place of names. T: a whole
/// number, double, std::string, an optional of these two, or a vector of int,
/// long or std::string. The value must outlive the parse.
template <typename T>
Option AddOption(CLI::App* command,
                 const std::string& usage,
                 T& value,
                 const std::string& about);
Option AddOption(CLI::App* command,
                 const std::string& usage,
                 const std::function<void(const std::string&)>& take,
                 const std::string& about);
Option AddOption(
    CLI::App* command,
    const std::string& usage,
    const std::function<void(const std::vector<std::string>&)>& take,
    const std::string& about);

/// One that takes one of `words`; `choose` is told which.
void AddWordOption(CLI::App* command,
                   const std::string& name,
                   const std::string& about,
                   const std::vector<std::string>& words,
                   const std::string& usual,
                   std::function<void(std::size_t)> choose);

/// One of words, each of which stands for a value that ToString names.
template <typename Value>
void AddChoice(CLI::App* command,
               const std::string& name,
               const std::string& about,
               const std::vector<Value>& values,
               Value* chosen) {
  std::vector<std::string> words;
  for (const Value value : values) words.emplace_back(ToString(value));
  AddWordOption(command,
                name,
                about,
                words,
                std::string(ToString(*chosen)),
                [values, chosen](std::size_t i) { *chosen = values[i]; });
}

Option AddFlag(CLI::App* command,
               const std::string& name,
               bool& value,
               const std::string& about);
Option AddFlag(CLI::App* command,
               const std::string& name,
               std::function<void()> act,
               const std::string& about);

/// One that is there already.
Option FindOption(CLI::App* command, const std::string& name);

/// Leaves options that are there already to help COMMAND --all.
void MarkSeldom(CLI::App* command, const std::vector<const char*>& names);

/// What help ends with.
void SetFooter(CLI::App* command, const std::string& text);

/// What is done where the command is chosen.
void OnRun(CLI::App* command, std::function<void()> run);

/// Names of the options that the parsed words held.
std::set<std::string> GivenOptions(const CLI::App& command);

/// Reads words by the options that `add` adds; returns the names of those
/// given. Throws UsageError.
std::set<std::string> ParseWords(std::vector<std::string> words,
                                 const std::function<void(CLI::App*)>& add);

}  // namespace errmap::cli
