#include "cli/shell/terminal.h"

#include <algorithm>
#include <cstdlib>
#include <unistd.h>

#include <sys/ioctl.h>

#include "cli/report/wrap_text.h"
#include "cli/shell/standard_streams.h"

namespace errmap::cli {
namespace {

constexpr long kFewestColumns = 40;

// A whole number of a sensible size in the environment, or 0.
std::size_t Wanted(const char* name, long least) {
  constexpr long kMost = 10000;
  const char* const text = std::getenv(name);
  if (text == nullptr) return 0;
  char* end = nullptr;
  const long number = std::strtol(text, &end, 10);
  if (*end != '\0' || number < least || number > kMost) return 0;
  return static_cast<std::size_t>(number);
}

bool IsSet(const char* name) {
  const char* const text = std::getenv(name);
  return text != nullptr && *text != '\0';
}

// `text` with its lines of more than `width` columns broken at blanks; what
// goes on stands below what it goes on with, in the second column of a list of
// options.
std::string FitLines(std::string_view text, std::size_t width) {
  constexpr std::size_t kSecondColumn = 30;  // of CLI11's help
  constexpr std::size_t kNarrowest = 20;
  std::string fitted;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t first = line.find_first_not_of(' ');
    const bool is_option = first > 0 && line.size() > kSecondColumn &&
                           line[kSecondColumn - 1] == ' ' &&
                           line[kSecondColumn] != ' ';
    const std::size_t indent = is_option ? kSecondColumn : first;
    if (report::WidthOf(line) <= width || first == std::string_view::npos ||
        indent + kNarrowest > width) {
      fitted.append(line).append("\n");
      continue;
    }
    fitted.append(line.substr(0, indent));
    std::string begin;
    for (const std::string& part :
         report::WrapLines(line.substr(indent), width - indent)) {
      fitted.append(begin).append(part).append("\n");
      begin.assign(indent, ' ');
    }
  }
  return fitted;
}

}  // namespace

report::Terminal OutputTerminal() {
  constexpr long kFewestRows = 5;
  report::Terminal terminal;
  winsize size{};
  if (isatty(STDOUT_FILENO) == 1) {
    const char* const kind = std::getenv("TERM");
    terminal.colour = !IsSet("NO_COLOR") && kind != nullptr &&
                      std::string_view(kind) != "dumb";
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0) {
      if (size.ws_col >= kFewestColumns) terminal.columns = size.ws_col;
      if (size.ws_row >= kFewestRows) terminal.rows = size.ws_row;
    }
  }
  if (const std::size_t columns = Wanted("COLUMNS", kFewestColumns)) {
    terminal.columns = columns;
  }
  if (const std::size_t rows = Wanted("LINES", kFewestRows)) {
    terminal.rows = rows;
  }
  return terminal;
}

void PrintFitted(std::string_view text) {
  const report::Terminal terminal = OutputTerminal();
  PrintResult(isatty(STDOUT_FILENO) == 1 ||
                      Wanted("COLUMNS", kFewestColumns) > 0
                  ? FitLines(text, terminal.columns)
                  : std::string(text));
}

void PrintScreen(const report::Screen& screen) {
  if (!OutputTerminal().colour || screen.strong.empty()) {
    PrintResult(screen.text);
    return;
  }
  std::size_t line = 0;
  for (std::size_t at = 0; at < screen.text.size(); ++line) {
    const std::size_t end =
        std::min(screen.text.find('\n', at), screen.text.size());
    const std::string_view words(screen.text.data() + at, end - at);
    if (std::ranges::find(screen.strong, line) != screen.strong.end()) {
      PrintStrong(words);
    } else {
      PrintResult(words);
    }
    if (end < screen.text.size()) PrintResult("\n");
    at = end + 1;
  }
}

}  // namespace errmap::cli
