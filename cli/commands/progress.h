#pragma once

#include <chrono>
#include <cstddef>
#include <limits>
#include <mutex>
#include <string>

namespace errmap::cli {

/// The state of a run, for the progress display.
struct ProgressState {
  int done = 0;
  int all = 0;
  double seconds = 0.0;  // since the start
  /// Seconds left. NaN: estimated from the finished fits once a twentieth of
  /// all fits is done.
  double left = std::numeric_limits<double>::quiet_NaN();
  std::string best = {};     // best model so far, its error; "": none yet
  std::string holdout = {};  // the hold-out under which it is the best
  const char* what = "fits";
};

/// Returns "112/238 fits, 12.3 s, about 14 s left, best so far poly:eq8 1.9 um
/// (groups:5)" in at most `width` columns. Omits the least important parts
/// first.
std::string ProgressText(const ProgressState& state, std::size_t width);

/// Shows the progress of fits on stderr: a bar on a terminal, elsewhere a plain
/// line every ten seconds, so that short runs print nothing. Safe to call from
/// any thread.
class Progress {
 public:
  explicit Progress(bool enabled);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows the state; fills in `state.seconds` itself.
  void Show(ProgressState state);

 private:
  bool enabled_;
  bool on_terminal_;
  std::mutex mutex_;
  int shown_ = 0;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_line_;
};

}  // namespace errmap::cli
