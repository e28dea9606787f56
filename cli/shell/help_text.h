#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "cli/shell/command_reference.h"

namespace errmap::cli {

/// Returns all commands, one line each, grouped by purpose.
std::string ProgramHelp(const ProgramReference& program, std::size_t width);

/// Selects the options in a command's help.
enum class HelpOptions { kUsual, kAll };

/// Returns a command's usage, its options and an example.
std::string CommandHelp(const CommandReference& command,
                        HelpOptions options,
                        std::size_t width);

/// Returns an option's first sentence (with kAll also the others) and its
/// default.
std::string Explained(const OptionReference& option, HelpOptions options);

/// Returns the text for a call without arguments: the first steps.
std::string FirstSteps();

/// Returns the required arguments of `command`: "FILE.csv --model SPEC
/// [options]".
std::string UsageOf(const CommandReference& command);

/// A page of cli/manual, built into the program.
struct Topic {
  std::string name;       // "tutorial"
  std::string_view page;  // Markdown
};

/// Returns the topics in the order of cli/manual/pages.cmake; written by CMake.
const std::vector<Topic>& Topics();

std::vector<std::string> TopicNames();

/// Returns its first heading.
std::string TitleOf(const Topic& topic);

/// Formats the page for a terminal: headings, paragraphs and lists in lines of
/// `width`, code blocks and tables unchanged, links and pictures as their
/// words.
std::string TopicText(const Topic& topic, std::size_t width);

/// Returns the manual's page Reference in Markdown, from the program itself:
/// every command with its options, models with theirs, hold-outs, exit statuses
/// and column names.
std::string ReferencePage(const ProgramReference& program);

}  // namespace errmap::cli
