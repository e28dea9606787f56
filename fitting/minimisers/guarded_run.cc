#include "fitting/minimisers/guarded_run.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "fitting/interruption.h"

namespace errmap::fitting {

using Eigen::Map;
GuardedRun::GuardedRun(const Objective& f,
                       const StoppingRules& rules,
                       const RunControl& run,
                       std::int64_t patience)
    : f_(f), patience_(patience), monitor_(rules, run) {}

bool GuardedRun::Start(const VectorXd& x0) {
  best_ = x_ = x0;
  try {
    EvaluateHere();
  } catch (...) {
    Fail();
    return false;
  }
  best_cost_ = cost_;
  best_gradient_norm_ = gradient_norm_;
  return monitor_.Begin(cost_, gradient_norm_) &&
         !monitor_.StopAtGoal(cost_, gradient_norm_, x_.norm()) &&
         !monitor_.StopAtLimit(evaluations_, 1);
}

bool GuardedRun::Evaluate(const double* x) {
  if (stopped()) return false;
  try {
    return EvaluateAt(x);
  } catch (...) {
    Fail();
    return false;
  }
}

bool GuardedRun::EvaluateAt(const double* x) {
  if (++idle_ > patience_) {
    monitor_.Stop(
        Termination::kNoDescent,
        "the last " + std::to_string(patience_) +
            " points that the solver asked for brought no lower cost");
    return false;
  }
  if (std::equal(x, x + x_.size(), x_.data())) return is_finite_;
  if (monitor_.StopAtLimit(evaluations_, 1)) return false;
  const Map<const VectorXd> at(x, x_.size());
  // A solver lost in overflow gets its answer without a call.
  const double x_norm = at.norm();
  if (!std::isfinite(x_norm)) return false;
  x_ = at;
  x_norm_ = x_norm;
  EvaluateHere();
  // If rounding hides the cost's last fall, the gradient still shows it.
  if (is_finite_ &&
      (cost_ < best_cost_ ||
       (cost_ == best_cost_ && gradient_norm_ < best_gradient_norm_))) {
    Keep();
  }
  return is_finite_;
}

bool GuardedRun::Spend() {
  if (stopped() || monitor_.StopAtLimit(evaluations_, 1)) return false;
  ++evaluations_;
  return true;
}

void GuardedRun::EvaluateHere() {
  ++evaluations_;
  cost_ = f_.Evaluate(x_, &gradient_);
  gradient_norm_ = gradient_.norm();  // finite only where all of it is
  is_finite_ = std::isfinite(cost_) && std::isfinite(gradient_norm_);
}

void GuardedRun::Keep() {
  best_ = x_;
  best_cost_ = cost_;
  best_gradient_norm_ = gradient_norm_;
  is_iteration_open_ = true;
  idle_ = 0;
  monitor_.StopAtGoal(best_cost_, best_gradient_norm_, x_norm_);
}

void GuardedRun::EndIteration() {
  if (!is_iteration_open_) return;
  is_iteration_open_ = false;
  try {
    monitor_.EndIteration(best_cost_, best_gradient_norm_, best_);
  } catch (...) {
    Fail();
  }
  if (!stopped()) monitor_.StopAtSlowProgress(best_cost_);
}

void GuardedRun::Fail() noexcept {
  if (!stopped()) thrown_ = std::current_exception();
}

void GuardedRun::StopByWhatWasThrown() {
  const bool at_start = evaluations_ <= 1;
  const auto stop = [&](const std::string& what) {
    monitor_.Stop(at_start ? Termination::kFailed : Termination::kNoDescent,
                  "stopped by an exception: " + what);
  };
  try {
    std::rethrow_exception(thrown_);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const Interrupted&) {
    monitor_.Stop(Termination::kInterrupted, "interrupted in an evaluation");
  } catch (const std::exception& error) {
    stop(error.what());
  } catch (...) {
    stop("an exception of unknown type");
  }
}

Minimum GuardedRun::Finish(const std::string& solver_text) {
  EndIteration();
  if (thrown_ != nullptr) {
    StopByWhatWasThrown();
  } else if (!stopped()) {
    monitor_.Stop(
        Termination::kNoDescent,
        "the solver gave up before the gradient was small: " + solver_text);
  }
  return {std::move(best_), monitor_.Finish(best_cost_, best_gradient_norm_)};
}

}  // namespace errmap::fitting
