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

// Columns of a stream that is a terminal; 80 of any other. COLUMNS comes first.
std::size_t ColumnsOf(int stream) {
  if (const std::size_t wanted = Wanted("COLUMNS", kFewestColumns)) {
    return wanted;
  }
  winsize size{};
  return isatty(stream) == 1 && ioctl(stream, TIOCGWINSZ, &size) == 0 &&
                 size.ws_col >= kFewestColumns
             ? size.ws_col
             : report::Terminal{}.columns;
}

bool IsSet(const char* name) {
  const char* const text = std::getenv(name);
  return text != nullptr && *text != '\0';
}

// `text` with its lines of more than `width` columns broken at blanks; what
// goes on stands below what it goes on with.
std::string FitLines(std::string_view text, std::size_t width) {
  constexpr std::size_t kNarrowest = 20;
  std::string fitted;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t indent = line.find_first_not_of(' ');
    if (report::WidthOf(line) <= width || indent == std::string_view::npos ||
        indent + kNarrowest > width) {
      fitted.append(line).append("\n");
      continue;
    }
    fitted.append(line.substr(0, indent));
    std::string begin;
    for (const std::string& part : report::WrapLines(
             line.substr(indent), width - indent, report::LongWords::kWhole)) {
      fitted.append(begin).append(part).append("\n");
      begin.assign(indent, ' ');
    }
  }
  return fitted;
}

}  // namespace

report::Terminal OutputTerminal() {
  constexpr long kFewestRows = 5;
  if (CurrentHost() != nullptr) return {};
  report::Terminal terminal{.columns = ColumnsOf(STDOUT_FILENO)};
  winsize size{};
  if (isatty(STDOUT_FILENO) == 1) {
    const char* const kind = std::getenv("TERM");
    terminal.colour = !IsSet("NO_COLOR") && kind != nullptr &&
                      std::string_view(kind) != "dumb";
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 &&
        size.ws_row >= kFewestRows) {
      terminal.rows = size.ws_row;
    }
  }
  if (const std::size_t rows = Wanted("LINES", kFewestRows)) {
    terminal.rows = rows;
  }
  return terminal;
}

std::string MessageLines(std::string_view line) {
  if (isatty(STDERR_FILENO) != 1) return std::string(line) + "\n";
  constexpr const char* kIndent = "        ";
  const std::size_t width = ColumnsOf(STDERR_FILENO);
  std::string text;
  for (const std::string& part :
       report::WrapLines(line,
                         width - std::string_view(kIndent).size(),
                         report::LongWords::kWhole)) {
    text += (text.empty() ? "" : kIndent) + part + "\n";
  }
  return text;
}

void PrintFitted(std::string_view text) {
  PrintResult(FitLines(text, OutputTerminal().columns));
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
