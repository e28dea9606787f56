#pragma once

#include <chrono>
#include <cstddef>
#include <limits>
#include <mutex>
#include <string>

namespace errmap::cli {

/// What is done so far, for people who wait.
struct ProgressState {
  int done = 0;
  int all = 0;
  double seconds = 0.0;  // since the start
  /// Seconds that it will still take; NaN: as the fits done did, once a
  /// twentieth is done, since before that it is a guess.
  double left = std::numeric_limits<double>::quiet_NaN();
  std::string best = {};     // model so far and its error; "": none yet
  std::string holdout = {};  // that it is the best under
  const char* what = "fits";
};

/// "112/238 fits, 12.3 s, about 14 s left, best so far poly:eq8 1.9 um
/// (groups:5)", at most `width` columns: what matters less is left out first.
std::string ProgressText(const ProgressState& state, std::size_t width);

/// Says on stderr how far fits are: on a terminal a bar, elsewhere a plain line
/// every ten seconds, so that short runs say nothing. Safe to call from any
/// thread.
class Progress {
 public:
  explicit Progress(bool enabled);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `state.seconds` is filled in.
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
