#pragma once

#include <cstddef>
#include <functional>

namespace errmap::fitting {

namespace parallel {
/// The implementation of ParallelFor, compiled once.
void Run(int threads,
         std::size_t count,
         const std::function<void(std::size_t)>& job);
}  // namespace parallel

/// Calls job(0), job(1), ... job(count - 1) on `threads` threads (0: one per
/// core), started in this order as threads become free. Rethrows the first
/// exception and skips jobs not yet started.
template <typename Count, typename Job>
void ParallelFor(int threads, Count count, const Job& job) {
  parallel::Run(threads, static_cast<std::size_t>(count), [&](std::size_t i) {
    job(static_cast<Count>(i));
  });
}

}  // namespace errmap::fitting
