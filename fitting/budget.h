#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "fitting/optimizer.h"

namespace errmap::fitting {

/// The limits of one run, asked before each pass so that they always hold.
class Budget {
 public:
  Budget(const StoppingRules& rules, const RunControl& run)
      : rules_(rules), run_(run), start_(std::chrono::steady_clock::now()) {}

  /// The limit that forbids another pass of at most `needed` evaluations after
  /// `iterations` steps and `evaluations`, if any.
  std::optional<Termination> Exhausted(std::int64_t iterations,
                                       std::int64_t evaluations,
                                       std::int64_t needed) const {
    if (run_.stop != nullptr && run_.stop->load(std::memory_order_relaxed)) {
      return Termination::kInterrupted;
    }
    if (iterations >= rules_.iterations) return Termination::kIterationLimit;
    if (evaluations > rules_.evaluations - needed) {
      return Termination::kEvaluationLimit;
    }
    const std::chrono::duration<double> elapsed =
        std::chrono::steady_clock::now() - start_;
    if (elapsed.count() >= rules_.seconds) return Termination::kTimeLimit;
    return std::nullopt;
  }

 private:
  const StoppingRules& rules_;
  const RunControl& run_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace errmap::fitting
