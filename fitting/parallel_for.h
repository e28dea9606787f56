#pragma once

#include <cstddef>
#include <functional>

namespace errmap::fitting {

namespace parallel {
/// ParallelFor, compiled once.
void Run(int threads,
         std::size_t count,
         const std::function<void(std::size_t)>& job);
}  // namespace parallel

/// job(0), job(1), ... job(count - 1) on so many threads, begun in this order,
/// each where a thread is free; 0: one thread per core. Throws what was thrown
/// first; jobs that have not begun by then never do.
template <typename Count, typename Job>
void ParallelFor(int threads, Count count, const Job& job) {
  parallel::Run(threads, static_cast<std::size_t>(count), [&](std::size_t i) {
    job(static_cast<Count>(i));
  });
}

}  // namespace errmap::fitting
