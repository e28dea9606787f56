#include "cli/shell/terminal.h"

#include <algorithm>
#include <cstdlib>
#include <unistd.h>

#include <sys/ioctl.h>

#include "cli/shell/standard_streams.h"

namespace errmap::cli {
namespace {

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

}  // namespace

std::size_t Terminal::text_columns() const {
  constexpr std::size_t kMost = 100;
  return std::min(columns, kMost);
}

Terminal OutputTerminal() {
  constexpr long kFewestColumns = 40;
  constexpr long kFewestRows = 5;
  Terminal terminal;
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

void Screen::Add(std::string_view more, bool is_strong) {
  if (is_strong) {
    const auto first = static_cast<std::size_t>(std::ranges::count(text, '\n'));
    const auto lines = static_cast<std::size_t>(std::ranges::count(more, '\n'));
    for (std::size_t i = 0; i < std::max<std::size_t>(lines, 1); ++i) {
      strong.push_back(first + i);
    }
  }
  text += more;
}

void PrintScreen(const Screen& screen) {
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
