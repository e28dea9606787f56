#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "fitting/interruption.h"
#include "fitting/minimisers/optimizer.h"

namespace errmap::fitting {

/// Bookkeeping for every iterative optimizer: limits, goals, time, trace and
/// summary.
class RunMonitor {
 public:
  RunMonitor(const StoppingRules& rules, const RunControl& run)
      : rules_(rules), run_(run), start_(Clock::now()), last_(start_) {
    constexpr std::int64_t kReserved = std::int64_t{1} << 16;
    if (run.keep_trace) {
      summary_.trace.reserve(
          static_cast<std::size_t>(std::min(kReserved, rules.iterations + 1)));
    }
  }

  /// Records the start, before any iteration. Returns false, and stops the run
  /// as failed, if it is not finite.
  bool Begin(double cost, double gradient_norm) {
    summary_.initial_cost = summary_.final_cost = cost;
    summary_.initial_gradient_norm = summary_.final_gradient_norm =
        gradient_norm;
    if (!std::isfinite(cost) || !std::isfinite(gradient_norm)) {
      Stop(Termination::kFailed,
           "the cost or its gradient is not finite at the start");
      return false;
    }
    summary_.message = "still running";
    last_checked_rms_ = RmsError(cost);
    Trace(cost, gradient_norm);
    last_ = Clock::now();
    return true;
  }

  /// Records the end of an iteration at x, with this cost and gradient.
  template <typename Vector>
  void EndIteration(double cost, double gradient_norm, const Vector& x) {
    ++summary_.iterations;
    ++steps_since_check_;
    const Clock::time_point now = Clock::now();
    const std::chrono::duration<double> taken = now - last_;
    last_ = now;
    // Welford's recurrence.
    const double offset = taken.count() - mean_seconds_;
    mean_seconds_ += offset / static_cast<double>(summary_.iterations);
    squares_ += offset * (taken.count() - mean_seconds_);
    Trace(cost, gradient_norm);
    if (!run_.after_iteration) return;
    const VectorXd& at = x.template cast<double>();
    if (!run_.after_iteration({summary_.iterations, cost, gradient_norm, at})) {
      Stop(Termination::kInterrupted, "ended by the caller");
    }
  }

  /// Ends the run if it was interrupted, or if a limit (iterations,
  /// evaluations, time) forbids another pass of at most `needed` evaluations
  /// after `evaluations`. Called before each pass, so that limits always hold.
  bool StopAtLimit(std::int64_t evaluations, std::int64_t needed) {
    const auto limit = Exhausted(evaluations, needed);
    if (!limit) return false;
    Stop(*limit,
         *limit == Termination::kInterrupted
             ? "interrupted; the best point so far is kept"
             : "a limit was reached before the gradient was small");
    return true;
  }

  bool ReachesCostGoal(double cost) const {
    return rules_.cost_goal > 0.0 && RmsError(cost) < rules_.cost_goal;
  }

  /// True if |g| < gradient_goal max(1, |x|), or if the gradient is 0.
  bool ReachesGradientGoal(double gradient_norm, double x_norm) const {
    return gradient_norm < rules_.gradient_goal * std::max(1.0, x_norm) ||
           gradient_norm == 0.0;
  }

  /// Ends the run at either goal.
  bool StopAtGoal(double cost, double gradient_norm, double x_norm) {
    if (ReachesCostGoal(cost)) {
      Stop(Termination::kCostGoal, "the error goal was reached");
    } else if (ReachesGradientGoal(gradient_norm, x_norm)) {
      Stop(Termination::kGradient, "the gradient is small: a minimum");
    }
    return stopped_;
  }

  /// Every progress_interval iterations, ends the run if the error has not
  /// fallen to slow_ratio times its value at the last check.
  bool StopAtSlowProgress(double cost) {
    if (steps_since_check_ < rules_.progress_interval) return false;
    steps_since_check_ = 0;
    const double rms = RmsError(cost);
    // Below 0 the same share of its size must be gained.
    const double ratio =
        last_checked_rms_ < 0.0 ? 2.0 - rules_.slow_ratio : rules_.slow_ratio;
    if (rms > ratio * last_checked_rms_) {
      Stop(Termination::kSlowProgress,
           "the error fell too little since the last check");
    }
    last_checked_rms_ = rms;
    return stopped_;
  }

  void Stop(Termination termination, std::string message) {
    summary_.termination = termination;
    summary_.message = std::move(message);
    stopped_ = true;
  }

  bool stopped() const { return stopped_; }
  bool has_failed() const {
    return stopped_ && summary_.termination == Termination::kFailed;
  }
  std::int64_t iterations() const { return summary_.iterations; }

  /// Returns the summary of a run that ended with these values.
  FitSummary Finish(double cost, double gradient_norm) {
    summary_.final_cost = cost;
    summary_.final_gradient_norm = gradient_norm;
    if (summary_.iterations > 0) {
      summary_.mean_iteration_seconds = mean_seconds_;
    }
    if (summary_.iterations > 1) {
      summary_.sd_iteration_seconds =
          std::sqrt(squares_ / static_cast<double>(summary_.iterations - 1));
    }
    return std::move(summary_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::optional<Termination> Exhausted(std::int64_t evaluations,
                                       std::int64_t needed) const {
    if (IsInterrupted() ||
        (run_.stop != nullptr && run_.stop->load(std::memory_order_relaxed))) {
      return Termination::kInterrupted;
    }
    if (summary_.iterations >= rules_.iterations) {
      return Termination::kIterationLimit;
    }
    if (evaluations > rules_.evaluations - needed) {
      return Termination::kEvaluationLimit;
    }
    const std::chrono::duration<double> elapsed = Clock::now() - start_;
    if (elapsed.count() >= rules_.seconds) return Termination::kTimeLimit;
    return std::nullopt;
  }

  void Trace(double cost, double gradient_norm) {
    if (run_.keep_trace) {
      summary_.trace.push_back(
          {summary_.iterations, RmsError(cost), gradient_norm});
    }
  }

  const StoppingRules& rules_;
  const RunControl& run_;
  const Clock::time_point start_;
  Clock::time_point last_;
  FitSummary summary_;
  std::int64_t steps_since_check_ = 0;
  double last_checked_rms_ = 0.0;
  double mean_seconds_ = 0.0;
  double squares_ = 0.0;
  bool stopped_ = false;
};

}  // namespace errmap::fitting
