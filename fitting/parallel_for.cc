#include "fitting/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "fitting/interruption.h"

namespace errmap::fitting::parallel {

void Run(int threads,
         std::size_t count,
         const std::function<void(std::size_t)>& job) {
  using oneapi::tbb::global_control;
  constexpr auto kAllowed = global_control::max_allowed_parallelism;
  if (threads == 0) threads = oneapi::tbb::info::default_concurrency();
  const auto workers = std::min(count, static_cast<std::size_t>(threads));
  if (workers <= 1) {
    for (std::size_t i = 0; i < count; ++i) job(i);
    return;
  }
  // More than there are cores are allowed first, else TBB complains and takes
  // fewer. A control inside another would lower what that allows.
  std::optional<global_control> allow;
  if (workers > global_control::active_value(kAllowed)) {
    allow.emplace(kAllowed, workers);
  }
  std::atomic<std::size_t> next{0};
  const std::atomic<bool>* const stop = InterruptionScope::Token();
  const auto work = [&](std::size_t /*worker*/) {
    const InterruptionScope interruptible(stop);
    try {
      for (std::size_t i = next++; i < count; i = next++) job(i);
    } catch (...) {
      next = count;
      throw;
    }
  };
  oneapi::tbb::task_arena arena(static_cast<int>(workers));
  arena.execute(
      [&] { oneapi::tbb::parallel_for(std::size_t{0}, workers, work); });
}

}  // namespace errmap::fitting::parallel
