#include "cli/progress.h"

#include <cstdio>
#include <string>
#include <unistd.h>

#include <fmt/format.h>

namespace errmap::cli {

Progress::Progress(bool enabled)
    : enabled_(enabled && isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (enabled_ && shown_ > 0) fmt::print(stderr, "\r\033[K");
}

void Progress::Show(int done, int all) {
  if (!enabled_ || all < 1) return;
  const std::lock_guard lock(mutex_);
  if (done <= shown_) return;  // a slower thread's older count
  shown_ = done;
  constexpr int kWidth = 30;
  const int filled = kWidth * done / all;
  const std::chrono::duration<double> elapsed =
      std::chrono::steady_clock::now() - start_;
  fmt::print(stderr,
             "\r[{}{}] {}/{} fits, {:.1f} s",
             std::string(static_cast<std::size_t>(filled), '#'),
             std::string(static_cast<std::size_t>(kWidth - filled), '.'),
             done,
             all,
             elapsed.count());
  std::fflush(stderr);
}

}  // namespace errmap::cli
