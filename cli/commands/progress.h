#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace errmap::cli {

/// What is done so far, for people who wait.
struct ProgressState {
  int done = 0;  // fits
  int all = 0;
  double seconds = 0.0;  // since the start
};

/// "112/238 fits, 12.3 s, about 14 s left"; the time left is said once a
/// twentieth is done, since before that it is a guess.
std::string ProgressText(const ProgressState& state);

/// Says on stderr how far fits are: on a terminal a bar, elsewhere a plain line
/// every ten seconds, so that short runs say nothing. Safe to call from any
/// thread.
class Progress {
 public:
  explicit Progress(bool enabled);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Show(int done, int all);

 private:
  bool enabled_;
  bool on_terminal_;
  std::mutex mutex_;
  int shown_ = 0;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_line_;
};

}  // namespace errmap::cli
