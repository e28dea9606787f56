#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/shell/help_text.h"
#include "data/text.h"
#include "models/recipe_catalog.h"
#include "stats/holdout.h"

namespace errmap::cli {
namespace {

// What each exit status says.
const std::vector<std::pair<int, std::string>>& ExitStatusWords() {
  static const std::vector<std::pair<int, std::string>> words = {
      {kDone, "done"},
      {kWrongCommandLine, "the command line is wrong"},
      {kUnusableInput, "the input is unusable; file, row and column are named"},
      {kEveryFitFailed, "every fit failed, or a check or floor was missed"},
      {kNothingJudged, "what was asked could not be judged, or is in doubt"},
      {kInterrupted, "interrupted; what was finished is kept"},
      {kOtherFailure, "anything else"}};
  return words;
}

// What a cell of a table in Markdown can hold.
std::string Cell(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  for (std::size_t at = 0; (at = text.find('|', at)) != text.npos; at += 2) {
    text.insert(at, "\\");
  }
  return text;
}

std::string Row(const std::string& code, const std::string& text) {
  return fmt::format("| `{}` | {} |\n", Cell(code), Cell(text));
}

std::string TableHead(const char* left, const char* right) {
  return fmt::format("| {} | {} |\n|---|---|\n", left, right);
}

std::string OptionRow(const OptionReference& option) {
  std::string name = data::JoinWords(option.names, ", ");
  if (!option.value.empty()) name += " " + option.value;
  return Row(name, Explained(option, HelpOptions::kAll));
}

std::string SectionOf(const CommandReference& command) {
  std::string text =
      fmt::format("### errmap {}\n\n{}.\n\n```text\nerrmap {} {}\n```\n\n",
                  command.name,
                  command.description,
                  command.name,
                  UsageOf(command));
  if (!command.positionals.empty() || !command.options.empty()) {
    text += TableHead("argument", "what it is");
  }
  for (const OptionReference& option : command.positionals) {
    text += OptionRow(option);
  }
  for (const OptionReference& option : command.options) {
    text += OptionRow(option);
  }
  if (!command.footer.empty()) {
    text += "\n```text\n" + command.footer + "\n```\n";
  }
  return text + "\n";
}

std::string Model(const std::string& type) {
  std::string text =
      fmt::format("### {}\n\n{}.\n\n", type, models::AboutModel(type));
  const std::vector<models::ModelOption> options = models::OptionsOfModel(type);
  if (options.empty()) return text;
  text += "| option | default | what it is, and its values |\n|---|---|---|\n";
  for (const models::ModelOption& option : options) {
    text += fmt::format("| `{}` | {} | {} |\n",
                        option.name,
                        Cell(option.fallback),
                        Cell(option.about + ": " + option.values));
  }
  return text + "\n";
}

}  // namespace

std::string ReferencePage(const ProgramReference& program) {
  std::string text = "# Reference\n\nWritten by the program itself.\n\n";
  std::string purpose;
  for (const CommandReference& command : program.commands) {
    if (command.purpose != purpose) {
      purpose = command.purpose;
      text += "## " + purpose + "\n\n";
    }
    text += SectionOf(command);
  }
  text += "## Models\n\n";
  for (const std::string& type : models::ModelTypes()) text += Model(type);
  text += "## Hold-outs\n\n" + TableHead("hold-out", "what it is");
  for (const stats::HoldoutForm& form : stats::HoldoutForms()) {
    text += Row(std::string(form.form), std::string(form.meaning));
  }
  text += "\n## Exit statuses\n\n" + TableHead("status", "what it says");
  for (const auto& [status, meaning] : ExitStatusWords()) {
    text += Row(std::to_string(status), meaning);
  }
  return text;
}

}  // namespace errmap::cli
