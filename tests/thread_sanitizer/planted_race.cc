// Two threads that count without a lock: what ThreadSanitizer must report, or
// its silence about errmap means nothing.

#include <atomic>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

int main() {
  volatile int count = 0;
  std::atomic<int> arrived{0};
  tbb::task_arena arena(2);
  arena.execute([&] {
    tbb::parallel_for(0, 2, [&](int /*i*/) {
      // Each waits for the other, so that there are two.
      arrived.fetch_add(1, std::memory_order_relaxed);
      while (arrived.load(std::memory_order_relaxed) < 2) {
      }
      count = count + 1;
    });
  });
  return 0;
}
