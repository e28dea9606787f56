#include "cli/shell/standard_streams.h"

#include <cerrno>
#include <cstddef>
#include <fcntl.h>
#include <unistd.h>

namespace errmap::cli {
namespace {

int print_error = 0;

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
  if (print_error == 0) print_error = WriteAll(STDOUT_FILENO, text);
}

int PrintError() { return print_error; }

void WriteMessage(std::string_view text) {
  static_cast<void>(WriteAll(STDERR_FILENO, text));
}

}  // namespace errmap::cli
