// Two threads that count without a lock: what ThreadSanitizer must report, or
// its silence about errmap means nothing.

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

int main() {
  constexpr int kTimes = 10'000;
  volatile int count = 0;
  tbb::task_arena arena(2);
  arena.execute([&] {
    tbb::parallel_for(0, kTimes, [&](int /*i*/) { count = count + 1; });
  });
  return 0;
}
