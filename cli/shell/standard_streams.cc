#include "cli/shell/standard_streams.h"

#include <cerrno>
#include <cstddef>
#include <fcntl.h>
#include <memory>
#include <mutex>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "data/text.h"

namespace errmap::cli {
namespace {

int print_error = 0;

using Options = std::set<std::string, std::less<>>;

std::mutex options_mutex;
std::shared_ptr<const Options> own_options;  // null: any may be advised

std::shared_ptr<const Options> OwnOptions() {
  const std::lock_guard lock(options_mutex);
  return own_options;
}

// 0, or the errno of what failed.
int WriteAll(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

std::string WithoutControls(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = data::Utf8Length(text, i);
    const auto first = static_cast<unsigned char>(text[i]);
    const bool is_c1 = length == 2 && first == 0xC2U &&
                       static_cast<unsigned char>(text[i + 1]) < 0xA0U;
    const bool is_c0 =
        (first < 0x20U && first != '\n' && first != '\t') || first == 0x7FU;
    if (length == 0 || is_c0 || is_c1) {
      const char byte = is_c1 ? text[i + 1] : text[i];
      safe += fmt::format("\\u{:04x}", static_cast<unsigned char>(byte));
      i += is_c1 ? 2 : 1;
    } else {
      safe += text.substr(i, length);
      i += length;
    }
  }
  return safe;
}

void HoldStandardStreams() {
  // open takes the lowest number that is free. What is open in the wrong
  // direction fails as a closed descriptor does.
  for (const int wanted : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(wanted, F_GETFD) >= 0) continue;
    const int direction = wanted == STDIN_FILENO ? O_WRONLY : O_RDONLY;
    const int held = open("/dev/null", direction);
    if (held >= 0 && held != wanted) close(held);
  }
}

void PrintResult(std::string_view text) {
  if (Host* const host = CurrentHost()) {
    host->printed += WithoutControls(text);
    return;
  }
  if (print_error != 0) return;
  print_error = WriteAll(STDOUT_FILENO, WithoutControls(text));
}

void PrintStrong(std::string_view text) {
  if (print_error != 0) return;
  print_error =
      WriteAll(STDOUT_FILENO, "\033[1m" + WithoutControls(text) + "\033[0m");
}

int PrintError() { return print_error; }

void AdviseOnly(std::set<std::string, std::less<>> options) {
  const std::lock_guard lock(options_mutex);
  own_options = std::make_shared<const Options>(std::move(options));
}

void AdviseAny() {
  const std::lock_guard lock(options_mutex);
  own_options = nullptr;
}

void WriteMessage(std::string_view text) {
  std::string line = WithoutControls(text);
  if (const auto options = OwnOptions()) {
    line = WithOwnRemedies(line, [&](std::string_view option) {
      return options->contains(option);
    });
  }
  for (std::size_t at = 0; (at = line.find('\n', at)) != std::string::npos;) {
    line.replace(at, 1, "\\n");
  }
  if (Host* const host = CurrentHost()) {
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    host->messages.push_back(std::move(line));
    return;
  }
  DrawOnTerminal(MessageLines("errmap: " + line));
}

void DrawOnTerminal(std::string_view text) {
  if (CurrentHost() != nullptr) return;  // it has no terminal
  static_cast<void>(WriteAll(STDERR_FILENO, text));
}

}  // namespace errmap::cli
