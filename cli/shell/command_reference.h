#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace errmap::cli {

/// The group (CLI11's term) of options that help shows only with --all.
inline constexpr const char* kSeldom = "Seldom needed";

/// An option or a positional argument of a command, as in its help.
struct OptionReference {
  std::vector<std::string> names;    // "-o", "--output"; or a positional's word
  std::string value;                 // "FILE.csv", "table|json"; "" for a flag
  std::vector<std::string> choices;  // the only values allowed, if any
  std::string description;  // text after a line feed is shown with --all
  std::string fallback;     // default, as text; "" if there is none
  bool required = false;
  bool repeatable = false;
  bool seldom = false;
};

struct CommandReference {
  std::string name;
  std::string purpose{};  // its purpose: the heading above it in help
  std::string description;
  std::string footer;  // "" if it has none of its own
  std::vector<OptionReference> positionals;
  std::vector<OptionReference> options;  // without --help
};

/// The whole command line. The reference page and completions are made from it,
/// so that they cannot differ from what the program accepts.
struct ProgramReference {
  std::string description;
  std::string footer;
  std::vector<CommandReference> commands;
};

/// Reads the commands of `app`.
ProgramReference DescribeProgram(const CLI::App& app);

}  // namespace errmap::cli
