#include "cli/commands/progress.h"

#include <string>
#include <unistd.h>

#include <fmt/format.h>

#include "cli/shell/standard_streams.h"
#include "cli/study_file/rough_time.h"

namespace errmap::cli {

std::string ProgressText(const ProgressState& state) {
  constexpr int kEnoughToTell = 20;  // a twentieth
  std::string text =
      fmt::format("{}/{} fits, {:.1f} s", state.done, state.all, state.seconds);
  if (state.done > 0 && state.done < state.all &&
      state.done >= state.all / kEnoughToTell) {
    const double left = state.seconds * (state.all - state.done) / state.done;
    text += ", about " + RoughTimeText(left) + " left";
  }
  return text;
}

Progress::Progress(bool enabled)
    : enabled_(enabled),
      on_terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      last_line_(start_) {}

Progress::~Progress() {
  if (enabled_ && on_terminal_ && shown_ > 0) DrawOnTerminal("\r\033[K");
}

void Progress::Show(int done, int all) {
  constexpr int kWidth = 30;
  constexpr std::chrono::seconds kBetweenLines(10);
  if (!enabled_ || all < 1) return;
  const std::lock_guard lock(mutex_);
  if (done <= shown_) return;  // a slower thread's older count
  shown_ = done;
  const auto now = std::chrono::steady_clock::now();
  const std::string text = ProgressText(
      {.done = done,
       .all = all,
       .seconds = std::chrono::duration<double>(now - start_).count()});
  if (!on_terminal_) {
    if (now - last_line_ < kBetweenLines) return;
    last_line_ = now;
    WriteMessage(text);
    return;
  }
  const int filled =
      static_cast<int>(static_cast<long long>(kWidth) * done / all);
  DrawOnTerminal(
      fmt::format("\r[{}{}] {}\033[K",
                  std::string(static_cast<std::size_t>(filled), '#'),
                  std::string(static_cast<std::size_t>(kWidth - filled), '.'),
                  text));
}

}  // namespace errmap::cli
