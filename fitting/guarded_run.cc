#include "fitting/guarded_run.h"

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
  const double norm = gradient_.norm();
  best_cost_ = cost_;
  best_gradient_norm_ = norm;
  return monitor_.Begin(cost_, norm) &&
         !monitor_.StopAtGoal(cost_, norm, x_.norm()) &&
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
  const Map<const VectorXd> at(x, x_.size());
  if (at == x_) return is_finite_;
  if (monitor_.StopAtLimit(evaluations_, 1)) return false;
  // A solver that has lost itself in overflow is told so without a call.
  if (!at.allFinite()) return false;
  x_ = at;
  is_finite_ = EvaluateHere();
  // Where rounding hides the cost's last fall, the gradient still shows it.
  if (is_finite_ &&
      (cost_ < best_cost_ ||
       (cost_ == best_cost_ && gradient_.norm() < best_gradient_norm_))) {
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
  return std::isfinite(cost_) && gradient_.allFinite() &&
         std::isfinite(gradient_.norm());
}

void GuardedRun::Keep() {
  best_ = x_;
  best_cost_ = cost_;
  best_gradient_norm_ = gradient_.norm();
  is_iteration_open_ = true;
  idle_ = 0;
  monitor_.StopAtGoal(best_cost_, best_gradient_norm_, best_.norm());
}

void GuardedRun::EndIteration() {
  if (!is_iteration_open_) return;
  is_iteration_open_ = false;
  monitor_.EndIteration(best_cost_, best_gradient_norm_);
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
