#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace errmap::cli {

/// Prefix of an option's group (CLI11's term) if help shows it only with --all.
/// The heading follows.
inline constexpr std::string_view kSeldom = "Seldom needed: ";

/// First and last heading of options in help.
inline constexpr std::string_view kDataOptions = "Data";
inline constexpr std::string_view kOutputOptions = "Output";

/// An option or a positional argument of a command, as in its help.
struct OptionReference {
  std::vector<std::string> names =
      {};                            // "-o", "--output"; or a positional's word
  std::string value;                 // "FILE.csv", "table|json"; "" for a flag
  std::vector<std::string> choices;  // the only values allowed, if any
  std::string description;  // text after a line feed is shown with --all
  std::string fallback;     // default, as text; "" if there is none
  bool required = false;
  bool repeatable = false;
  bool seldom = false;
  std::string heading{};  // above it in help
};

struct CommandReference {
  std::string name;
  std::string purpose{};  // its purpose: the heading above it in help
  std::string description;
  std::string footer;  // "" if it has none of its own
  std::vector<OptionReference> positionals = {};
  std::vector<OptionReference> options = {};  // without --help
};

/// The whole command line. The reference page and completions are made from it,
/// so they always agree with the program.
struct ProgramReference {
  std::string description;
  std::string footer;
  std::vector<CommandReference> commands = {};
};

/// Reads the commands of `app`.
ProgramReference DescribeProgram(const CLI::App& app);

}  // namespace errmap::cli
