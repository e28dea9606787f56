#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace errmap::cli {

/// The group (CLI11's word) of options that a command's help names with --all.
inline constexpr const char* kSeldom = "Seldom needed";

/// An option or a positional argument of a command, as its help has it.
struct OptionReference {
  std::vector<std::string> names;  // "-o", "--output"; a positional's one word
  std::string value;               // "FILE.csv", "table|json"; "" for a flag
  std::vector<std::string> choices;  // the only values allowed, if any
  std::string description;  // what follows a line feed is said with --all
  std::string fallback;     // default, as text; "" where there is none
  bool required = false;
  bool repeatable = false;
  bool seldom = false;
};

struct CommandReference {
  std::string name;
  std::string purpose{};  // what it serves, the heading it stands under
  std::string description;
  std::string footer;  // "" where it has none of its own
  std::vector<OptionReference> positionals;
  std::vector<OptionReference> options;  // --help is not among them
};

/// The whole command line: what the reference page and completions are made
/// from, so that they cannot differ from what the program takes.
struct ProgramReference {
  std::string description;
  std::string footer;
  std::vector<CommandReference> commands;
};

/// Reads the commands off `app`.
ProgramReference DescribeProgram(const CLI::App& app);

}  // namespace errmap::cli
