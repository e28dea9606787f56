#pragma once

#include <functional>

namespace errmap::models {

/// Runs `work` where parallel loops have `jobs` threads, 1 at least. More than
/// there are cores are allowed first: else TBB complains and takes fewer.
void InJobsArena(int jobs, const std::function<void()>& work);

}  // namespace errmap::models
