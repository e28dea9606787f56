#pragma once

#include <cstddef>
#include <optional>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

namespace errmap::models {

/// Runs `work` where parallel loops have `jobs` threads, 1 at least. More than
/// there are cores must be allowed first, or TBB complains and takes fewer; a
/// control inside another would lower what that allows.
template <typename Work>
void InJobsArena(int jobs, const Work& work) {
  using oneapi::tbb::global_control;
  constexpr auto kAllowed = global_control::max_allowed_parallelism;
  std::optional<global_control> allow_jobs;
  const auto wanted = static_cast<std::size_t>(jobs);
  if (wanted > global_control::active_value(kAllowed)) {
    allow_jobs.emplace(kAllowed, wanted);
  }
  oneapi::tbb::task_arena arena(jobs);
  arena.execute(work);
}

}  // namespace errmap::models
