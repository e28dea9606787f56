#include "cli/commands/progress.h"

#include <array>
#include <cmath>
#include <string>
#include <unistd.h>

#include <fmt/format.h>

#include "cli/report/wrap_text.h"
#include "cli/shell/standard_streams.h"
#include "cli/study_setup/plan/study_forecast.h"

namespace errmap::cli {

std::string ProgressText(const ProgressState& state, std::size_t width) {
  constexpr int kEnoughToTell = 20;  // a twentieth
  const std::string fits =
      fmt::format("{}/{} {}", state.done, state.all, state.what);
  const std::string elapsed = fmt::format(", {:.1f} s", state.seconds);
  double seconds_left = state.left;
  if (!std::isfinite(seconds_left) && state.done >= state.all / kEnoughToTell) {
    seconds_left = state.seconds * (state.all - state.done) / state.done;
  }
  std::string about;
  std::string left;
  if (std::isfinite(seconds_left) && state.done < state.all) {
    about = ", about ";
    left = study_setup::RoughTimeText(seconds_left) + " left";
  }
  std::string whole = fits + elapsed + about + left;
  if (state.best.empty()) return whole;
  const std::string best = ", best so far " + state.best;
  const std::string brief = left.empty() ? "" : ", " + left;
  const std::array texts = {whole + best + " (" + state.holdout + ")",
                            whole + best,
                            fits + brief + best};
  for (const std::string& text : texts) {
    if (report::WidthOf(text) <= width) return text;
  }
  return whole;
}

Progress::Progress(bool enabled)
    : enabled_(enabled),
      on_terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      last_line_(start_) {}

Progress::~Progress() {
  if (enabled_ && on_terminal_ && shown_ > 0) DrawOnTerminal("\r\033[K");
}

void Progress::Show(ProgressState state) {
  constexpr std::size_t kBar = 10;
  constexpr std::size_t kWidth = 79;
  constexpr std::chrono::seconds kBetweenLines(10);
  if (!enabled_ || state.all < 1) return;
  const std::lock_guard lock(mutex_);
  if (state.done <= shown_) return;  // a slower thread's older count
  shown_ = state.done;
  const auto now = std::chrono::steady_clock::now();
  state.seconds = std::chrono::duration<double>(now - start_).count();
  if (!on_terminal_) {
    if (now - last_line_ < kBetweenLines) return;
    last_line_ = now;
    state.best.clear();
    WriteMessage(ProgressText(state, kWidth));
    return;
  }
  const std::size_t filled = kBar * static_cast<std::size_t>(state.done) /
                             static_cast<std::size_t>(state.all);
  DrawOnTerminal(fmt::format("\r[{}{}] {}\033[K",
                             std::string(filled, '#'),
                             std::string(kBar - filled, '.'),
                             ProgressText(state, kWidth - kBar - 3)));
}

}  // namespace errmap::cli
