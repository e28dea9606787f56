#include "models/jobs_arena.h"

#include <cstddef>
#include <optional>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

namespace errmap::models {

void InJobsArena(int jobs, const std::function<void()>& work) {
  using oneapi::tbb::global_control;
  constexpr auto kAllowed = global_control::max_allowed_parallelism;
  // A control inside another would lower what that allows.
  std::optional<global_control> allow_jobs;
  const auto wanted = static_cast<std::size_t>(jobs);
  if (wanted > global_control::active_value(kAllowed)) {
    allow_jobs.emplace(kAllowed, wanted);
  }
  oneapi::tbb::task_arena arena(jobs);
  arena.execute(work);
}

}  // namespace errmap::models
