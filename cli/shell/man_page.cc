#include "cli/shell/man_page.h"

#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "cli/command.h"
#include "models/recipe_catalog.h"
#include "models/version.h"

namespace errmap::cli {
namespace {

// Text as roff reads it: a backslash and a leading '.' or ''' would be its own.
std::string Escape(std::string_view text) {
  std::string escaped;
  bool line_start = true;
  for (const char c : text) {
    if (line_start && (c == '.' || c == '\'')) escaped += "\\&";
    line_start = c == '\n';
    switch (c) {
      case '\\':
        escaped += "\\e";
        break;
      case '-':
        escaped += "\\-";
        break;
      case '~':
        escaped += "\\(ti";
        break;
      case '^':
        escaped += "\\(ha";
        break;
      case '`':
        escaped += "\\(ga";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string Bold(const std::string& text) {
  return "\\fB" + Escape(text) + "\\fR";
}

std::string Italic(const std::string& text) {
  return "\\fI" + Escape(text) + "\\fR";
}

// Text of a help page: blank lines part paragraphs, "Example: ..." is one of
// its own, other line ends are nothing but blanks.
std::string Paragraphs(const std::string& text) {
  constexpr std::string_view kExample = "Example: ";
  std::istringstream lines(text);
  std::string roff;
  bool new_paragraph = false;
  for (std::string line; std::getline(lines, line);) {
    const bool example = line.starts_with(kExample);
    if (!roff.empty() && (new_paragraph || example)) roff += ".PP\n";
    new_paragraph = example || line.empty();
    if (example) {
      roff += "Example:\n.PP\n.nf\n.RS 4\n" +
              Escape(line.substr(kExample.size())) + "\n.RE\n.fi\n";
    } else if (!line.empty()) {
      roff += Escape(line) + "\n";
    }
  }
  return roff;
}

std::string Synopsis(const CommandReference& command) {
  std::string roff = Bold(command.name);
  for (const OptionReference& positional : command.positionals) {
    const std::string name = Italic(
        positional.value.empty() ? positional.names.front() : positional.value);
    roff += positional.required ? " " + name : " [" + name + "]";
  }
  for (const OptionReference& option : command.options) {
    if (!option.required) continue;
    roff += " " + Bold(option.names.front()) +
            (option.value.empty() ? "" : " " + Italic(option.value));
  }
  return roff + (command.options.empty() ? "" : " [options]");
}

std::string OptionEntry(const OptionReference& option) {
  std::string roff = ".TP\n";
  for (std::size_t i = 0; i < option.names.size(); ++i) {
    roff += (i == 0 ? "" : ", ") + Bold(option.names[i]);
  }
  if (!option.value.empty()) roff += " " + Italic(option.value);
  std::string text = option.description;
  if (!option.fallback.empty()) {
    text += fmt::format(" (default: {})", option.fallback);
  }
  return roff + "\n" + Escape(text) + "\n";
}

std::string CommandSection(const CommandReference& command) {
  std::string roff = fmt::format(".SS {}\n", Synopsis(command));
  roff += Escape(command.description) + ".\n";
  for (const OptionReference& positional : command.positionals) {
    roff += OptionEntry(positional);
  }
  for (const OptionReference& option : command.options) {
    roff += OptionEntry(option);
  }
  if (!command.footer.empty()) roff += ".PP\n" + Paragraphs(command.footer);
  return roff;
}

// The options of a model, with the values that serve unless others are given.
std::string ModelOptions(const std::string& type) {
  std::string text;
  for (const models::ModelOption& option : models::OptionsOfModel(type)) {
    text += (text.empty() ? "" : ", ") + option.name;
    if (!option.fallback.empty()) text += "=" + option.fallback;
  }
  return text.empty() ? "no options" : text;
}

std::string Models() {
  std::string roff =
      ".SH MODELS\nOptions follow a model after colons, as in\n" +
      Bold("net:scg:hidden=60:wfactor=1e-3") +
      ".\nThese are the options of each, with their defaults where they are "
      "fixed:\n";
  for (const std::string& type : models::ModelTypes()) {
    roff += fmt::format(".TP\n{}\n{}: {}\n",
                        Bold(type),
                        Escape(models::AboutModel(type)),
                        Escape(ModelOptions(type)));
  }
  return roff + ".TP\n" + Bold("poly:formula=") + Italic("x+x^2+x*t") +
         "\nthe terms as written\n";
}

std::string ExitStatusSection() {
  std::string roff = ".SH EXIT STATUS\n";
  for (const auto& [status, meaning] : ExitStatusWords()) {
    roff += fmt::format(
        ".TP\n{}\n{}\n", Bold(std::to_string(status)), Escape(meaning));
  }
  return roff +
         ".PP\nOne line on standard error says what is wrong and what to do.\n";
}

constexpr std::string_view kFiles =
    ".SH FILES\n"
    "Results and model files are JSON; their schemas\n"
    "(\\fIerrmap\\-results\\-1.schema.json\\fR,\n"
    "\\fIerrmap\\-model\\-1.schema.json\\fR ...) are installed in\n"
    "\\fIshare/errmap/schemas\\fR beside the program's folder.\n"
    ".SH SEE ALSO\n"
    "D. E. Gilsinn and M. A. Donmez,\n"
    "\\fIPrediction of Geometric\\-Thermal Machine Tool Errors by Artificial\n"
    "Neural Networks\\fR, NISTIR 5367, 1995.\n";

}  // namespace

const std::vector<std::pair<int, std::string>>& ExitStatusWords() {
  static const std::vector<std::pair<int, std::string>> words = {
      {kDone, "done"},
      {kWrongCommandLine, "the command line is wrong"},
      {kUnusableInput, "the input is unusable; file, row and column are named"},
      {kEveryFitFailed, "every fit failed, or a check or floor was missed"},
      {kInterrupted, "interrupted; what was finished is kept"},
      {kOtherFailure, "anything else"}};
  return words;
}

std::string ManPage(const ProgramReference& program) {
  std::string roff = fmt::format(
      ".TH ERRMAP 1 \"\" \"errmap {}\" \"User Commands\"\n"
      ".nh\n.ad l\n"
      ".SH NAME\nerrmap \\- maps of machine tool errors that hold on another "
      "day\n"
      ".SH SYNOPSIS\n{} {} [options]\n.br\n{} [{}] {} | {}\n",
      models::Version(),
      Bold("errmap"),
      Italic("COMMAND"),
      Bold("errmap"),
      Italic("COMMAND"),
      Bold("--help"),
      Bold("--version"));
  roff += ".SH DESCRIPTION\n" + Paragraphs(program.description) + ".PP\n" +
          Paragraphs(program.footer);
  roff += ".SH COMMANDS\n";
  for (const CommandReference& command : program.commands) {
    roff += CommandSection(command);
  }
  roff += Models();
  roff += ExitStatusSection();
  roff += kFiles;
  return roff;
}

}  // namespace errmap::cli
