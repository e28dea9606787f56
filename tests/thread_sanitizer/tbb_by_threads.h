#pragma once

// What errmap uses of oneTBB, by std::thread: ThreadSanitizer sees every lock
// and every join of it, where Debian's TBB, not built for it, hides how its
// threads wait for each other. The preset tsan puts include/ before TBB's own
// headers. No work is stolen, so it is slower; the results are the same.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#define TBB_VERSION_STRING "none, std::thread"
#define TBB_VERSION_MAJOR 0
#define TBB_VERSION_MINOR 0
#define TBB_VERSION_PATCH 0

namespace tbb {

namespace info {
inline int default_concurrency() {
  return std::max(2, static_cast<int>(std::thread::hardware_concurrency()));
}
}  // namespace info

namespace detail_by_threads {
// Threads of the arena that this thread works in.
inline thread_local int concurrency = info::default_concurrency();
}  // namespace detail_by_threads

class task_arena {
 public:
  explicit task_arena(int concurrency) : concurrency_(concurrency) {}

  template <typename Work>
  void execute(Work&& work) {
    const int before = detail_by_threads::concurrency;
    detail_by_threads::concurrency = concurrency_;
    try {
      work();
    } catch (...) {
      detail_by_threads::concurrency = before;
      throw;
    }
    detail_by_threads::concurrency = before;
  }

 private:
  int concurrency_;
};

class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter /*what*/, std::size_t /*value*/) {}
  static std::size_t active_value(parameter /*what*/) { return 1; }
};

/// work(i) for every i of [begin, end), on as many threads as the arena has.
/// Throws what was thrown first, when all have ended.
template <typename Index, typename Work>
void parallel_for(Index begin, Index end, const Work& work) {
  if (!(begin < end)) return;
  std::atomic<std::size_t> next{0};
  const auto count = static_cast<std::size_t>(end - begin);
  std::exception_ptr thrown;
  std::mutex mutex;
  const int concurrency = detail_by_threads::concurrency;
  const auto take_turns = [&] {
    detail_by_threads::concurrency = concurrency;
    // Relaxed: taking turns must not make order where the work makes none.
    const auto take = [&] {
      return next.fetch_add(1, std::memory_order_relaxed);
    };
    for (std::size_t i = take(); i < count; i = take()) {
      try {
        work(static_cast<Index>(begin + static_cast<Index>(i)));
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (thrown == nullptr) thrown = std::current_exception();
        next.store(count, std::memory_order_relaxed);
      }
    }
  };
  std::vector<std::thread> threads;
  const std::size_t most =
      std::min(count, static_cast<std::size_t>(std::max(1, concurrency)));
  while (threads.size() + 1 < most) threads.emplace_back(take_turns);
  take_turns();
  for (std::thread& thread : threads) thread.join();
  if (thrown != nullptr) std::rethrow_exception(thrown);
}

}  // namespace tbb

namespace oneapi {
namespace tbb = ::tbb;
}
