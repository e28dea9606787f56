#pragma once

#include <chrono>
#include <mutex>

namespace errmap::cli {

/// A progress bar on stderr while fits run; nothing where stderr is no
/// terminal. Safe to call from any thread.
class Progress {
 public:
  explicit Progress(bool enabled);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Show(int done, int all);

 private:
  bool enabled_;
  std::mutex mutex_;
  int shown_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace errmap::cli
