#include "fitting/minimisers/guarded_run.h"

#include <algorithm>
#include <cmath>
#include <exception>

namespace errmap::fitting {

using Eigen::Map;
using Eigen::VectorXd;

GuardedRun::GuardedRun(const Objective& f,
                       const StoppingRules& rules,
                       const RunControl& run,
                       std::int64_t patience)
    : f_(f), patience_(patience), monitor_(rules, run) {}

bool GuardedRun::Start(const VectorXd& x0) {
  best_ = x_ = x0;
  is_finite_ = EvaluateHere();
  if (has_thrown_) return false;
  best_cost_ = cost_;
  best_gradient_norm_ = gradient_norm_;
  return monitor_.Begin(cost_, gradient_norm_) &&
         !monitor_.StopAtGoal(cost_, gradient_norm_, x_.norm()) &&
         !monitor_.StopAtLimit(evaluations_, 1);
}

bool GuardedRun::Evaluate(const double* x) {
  if (stopped()) return false;
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
  // A solver that has lost itself in overflow is told so without a call.
  const double x_norm = at.norm();
  if (!std::isfinite(x_norm)) return false;
  x_ = at;
  x_norm_ = x_norm;
  is_finite_ = EvaluateHere();
  // Where rounding hides the cost's last fall, the gradient still shows it.
  if (is_finite_ &&
      (cost_ < best_cost_ ||
       (cost_ == best_cost_ && gradient_norm_ < best_gradient_norm_))) {
    Keep();
  }
  return is_finite_ && !has_thrown_;
}

bool GuardedRun::Spend() {
  if (stopped() || monitor_.StopAtLimit(evaluations_, 1)) return false;
  ++evaluations_;
  return true;
}

bool GuardedRun::EvaluateHere() {
  ++evaluations_;
  try {
    cost_ = f_.Evaluate(x_, &gradient_);
  } catch (const std::exception& error) {
    Fail(error.what());
    return false;
  } catch (...) {
    Fail("an exception of unknown type");
    return false;
  }
  gradient_norm_ = gradient_.norm();  // finite only where all of it is
  return std::isfinite(cost_) && std::isfinite(gradient_norm_);
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
  monitor_.EndIteration(best_cost_, best_gradient_norm_, best_);
  ++steps_since_check_;
  if (!stopped()) {
    monitor_.StopAtSlowProgress(best_cost_, &steps_since_check_);
  }
}

void GuardedRun::Fail(const std::string& what) {
  if (stopped()) return;
  has_thrown_ = true;
  const bool at_start = evaluations_ <= 1;
  monitor_.Stop(at_start ? Termination::kFailed : Termination::kNoDescent,
                "stopped by an exception: " + what);
}

Minimum GuardedRun::Finish(const std::string& solver_text) {
  EndIteration();
  if (!stopped()) {
    monitor_.Stop(
        Termination::kNoDescent,
        "the solver gave up before the gradient was small: " + solver_text);
  }
  return {std::move(best_), monitor_.Finish(best_cost_, best_gradient_norm_)};
}

}  // namespace errmap::fitting
