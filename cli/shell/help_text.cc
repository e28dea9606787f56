#include "cli/shell/help_text.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "cli/report/shell_word.h"
#include "cli/report/wrap_text.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

// Of the commands that have no other meaning of theirs.
constexpr std::string_view kExitStatus =
    "Exit status: 0 done, 2 wrong command line, 3 unusable input, 4 no result, "
    "130 interrupted.";

// Writes `name` with `text` to its right from `column` on; below it if they
// would overlap, or if too few columns were left.
std::string Entry(const std::string& name,
                  const std::string& text,
                  std::size_t column,
                  std::size_t width) {
  constexpr std::size_t kNarrowest = 20;
  constexpr std::size_t kBelow = 6;
  if (column + kNarrowest > width) column = kBelow;
  std::string entry = "  " + name;
  if (report::WidthOf(entry) + 1 > column) entry += "\n";
  std::size_t at = entry.ends_with('\n') ? 0 : report::WidthOf(entry);
  for (const std::string& line : report::WrapLines(text, width - column)) {
    entry += std::string(column - at, ' ') + line + "\n";
    at = 0;
  }
  if (!entry.ends_with('\n')) entry += "\n";
  return entry;
}

// Whether a line of a footer stands for itself, as a command that is indented
// does; the others go on with the line before.
bool BeginsAnew(const std::string& line) {
  if (line.empty() || line.front() == ' ') return true;
  constexpr const char* kBegins[] = {"Example", "Exit status", "- ", "errmap "};
  return std::ranges::any_of(
      kBegins, [&](const char* begin) { return line.starts_with(begin); });
}

constexpr std::string_view kExampleLabel = "Example: ";

// An example on a line of its own, and continued as a shell reads it.
std::string WrappedExample(const std::string& line, std::size_t width) {
  if (report::WidthOf(line) <= width) return line + "\n";
  constexpr std::size_t kIndent = 2;
  std::istringstream text(line.substr(kExampleLabel.size()));
  std::vector<std::string> words;
  for (std::string word; text >> std::quoted(word);) words.push_back(word);
  return std::string(kExampleLabel.substr(0, kExampleLabel.size() - 1)) + "\n" +
         std::string(kIndent, ' ') +
         report::ShellCommand(words, width, kIndent) + "\n";
}

std::string Wrapped(const std::string& text, std::size_t width) {
  std::istringstream lines(text);
  std::vector<std::string> paragraphs;
  for (std::string line; std::getline(lines, line);) {
    if (paragraphs.empty() || BeginsAnew(line) || paragraphs.back().empty() ||
        paragraphs.back().front() == ' ') {
      paragraphs.push_back(line);
    } else {
      paragraphs.back() += " " + line;
    }
  }
  std::string wrapped;
  for (const std::string& paragraph : paragraphs) {
    wrapped += paragraph.starts_with(kExampleLabel)
                   ? WrappedExample(paragraph, width)
                   : report::WrapText(paragraph, width) + "\n";
  }
  return wrapped;
}

// The first line of a text, and of those after it what closes its brackets.
std::string FirstStatement(const std::string& text) {
  std::size_t end = text.find('\n');
  const auto is_open = [&] {
    const auto line = std::string_view(text).substr(0, end);
    return std::ranges::count(line, '(') > std::ranges::count(line, ')');
  };
  while (end != text.npos && is_open()) end = text.find('\n', end + 1);
  return text.substr(0, end);
}

std::string OptionEntry(const OptionReference& option,
                        HelpOptions options,
                        std::size_t width) {
  constexpr std::size_t kColumn = 30;
  std::string name = data::JoinWords(option.names, ",");
  if (!option.value.empty()) name += " " + option.value;
  return Entry(name, Explained(option, options), kColumn, width);
}

std::vector<OptionReference> Shown(const CommandReference& command,
                                   HelpOptions options) {
  std::vector<OptionReference> shown;
  for (const OptionReference& option : command.options) {
    if (option.seldom && options == HelpOptions::kUsual) continue;
    shown.push_back(option);
  }
  return shown;
}

// Their headings in order, those of the output last.
std::vector<std::string> HeadingsOf(const std::vector<OptionReference>& shown) {
  std::vector<std::string> headings;
  bool has_output = false;
  for (const OptionReference& option : shown) {
    if (option.heading == kOutputOptions) {
      has_output = true;
    } else if (std::ranges::find(headings, option.heading) == headings.end()) {
      headings.push_back(option.heading);
    }
  }
  if (has_output) headings.emplace_back(kOutputOptions);
  return headings;
}

// Options under their headings, if there are enough to look for one.
std::string OptionEntries(const std::vector<OptionReference>& shown,
                          HelpOptions options,
                          std::size_t width) {
  constexpr std::size_t kFew = 10;
  std::string text;
  for (const std::string& heading : HeadingsOf(shown)) {
    if (shown.size() > kFew) text += heading + ":\n";
    for (const OptionReference& option : shown) {
      if (option.heading != heading) continue;
      text += OptionEntry(option, options, width);
    }
  }
  return text;
}

}  // namespace

std::string Explained(const OptionReference& option, HelpOptions options) {
  std::string text = FirstStatement(option.description);
  const std::string rest = option.description.substr(text.size());
  if (options == HelpOptions::kAll && !rest.empty()) {
    const bool is_sentence = rest[1] >= 'A' && rest[1] <= 'Z';
    text += (is_sentence ? "." : rest[1] == '(' ? "" : ";") + rest;
  }
  std::ranges::replace(text, '\n', ' ');
  if (!option.fallback.empty()) {
    text += fmt::format(" (default: {})", option.fallback);
  }
  return text;
}

std::string UsageOf(const CommandReference& command) {
  std::string usage;
  for (const OptionReference& positional : command.positionals) {
    const std::string name =
        positional.value.empty() ? positional.names.front() : positional.value;
    usage += positional.required ? " " + name : " [" + name + "]";
  }
  for (const OptionReference& option : command.options) {
    if (!option.required) continue;
    usage += " " + option.names.front();
    if (!option.value.empty()) usage += " " + option.value;
  }
  usage += command.options.empty() ? "" : " [options]";
  return usage.empty() ? usage : usage.substr(1);
}

std::string CommandHelp(const CommandReference& command,
                        HelpOptions options,
                        std::size_t width) {
  std::string text = Wrapped(command.description, width);
  text += Wrapped(
      fmt::format("Usage: errmap {} {}", command.name, UsageOf(command)),
      width);
  text += "\n";
  for (const OptionReference& positional : command.positionals) {
    text += OptionEntry(positional, options, width);
  }
  const std::vector<OptionReference> shown = Shown(command, options);
  text += OptionEntries(shown, options, width);
  std::string footer = command.footer;
  if (footer.find("Exit status") == footer.npos) {
    footer += (footer.empty() ? "" : "\n") + std::string(kExitStatus);
  }
  text += "\n" + Wrapped(footer, width);
  if (const std::size_t more = command.options.size() - shown.size()) {
    text += Wrapped(fmt::format("{} more option{}: errmap help {} --all",
                                more,
                                more == 1 ? "" : "s",
                                command.name),
                    width);
  }
  return text;
}

std::string ProgramHelp(const ProgramReference& program, std::size_t width) {
  constexpr std::size_t kColumn = 15;
  std::string text = Wrapped(program.description, width);
  text += "Usage: errmap COMMAND [options]\n";
  std::string purpose;
  for (const CommandReference& command : program.commands) {
    if (command.purpose != purpose) {
      purpose = command.purpose;
      text += "\n" + purpose + "\n";
    }
    text += Entry(command.name, command.description, kColumn, width);
  }
  return text + "\n" + Wrapped(program.footer, width);
}

std::string FirstSteps() {
  return "errmap finds which map of a machine tool's error holds on another "
         "day.\n\n"
         "  errmap compare DATA.csv             which map, how sure, what "
         "next\n"
         "  errmap export map.json --c -o DIR   the map as code for a control\n"
         "  errmap check map.json PROBES.csv    does it still hold today?\n\n"
         "DATA.csv has a header (position_mm, t1_degC, day, error_um) and a "
         "row "
         "per\nreading; compare says how to write map.json.\n"
         "errmap help tutorial shows how, errmap help words explains the "
         "words,\n"
         "errmap --help lists all commands.\n";
}

}  // namespace errmap::cli
