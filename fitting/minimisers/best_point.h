#pragma once

#include <cmath>

#include "fitting/minimisers/run_monitor.h"

namespace errmap::fitting {

/// Current point and best point so far, for optimizers whose cost may rise.
class BestPoint {
 public:
  BestPoint(const Objective& f,
            const VectorXd& x0,
            const StoppingRules& rules,
            const RunControl& run)
      : monitor(rules, run), x(x0), f_(f), best_(x0), trial_(x0.size()) {}

  /// Evaluates the start. Returns false if the run ends there.
  bool Start() {
    cost = Evaluate(x, &gradient);
    gradient_norm = gradient.norm();
    if (!monitor.Begin(cost, gradient_norm)) return false;
    Keep();
    return !monitor.StopAtGoal(cost, gradient_norm, x.norm());
  }

  double Evaluate(const VectorXd& at, VectorXd* slope) {
    ++evaluations;
    return f_.Evaluate(at, slope);
  }

  /// Makes one iteration: x += step, then checks every stop but the limits.
  /// Returns false if the run has ended.
  bool Move(const VectorXd& step, const char* not_finite) {
    trial_ = x + step;
    const double trial_cost = Evaluate(trial_, &trial_gradient_);
    if (!std::isfinite(trial_cost) || !trial_gradient_.allFinite()) {
      monitor.Stop(Termination::kNoDescent, not_finite);
      return false;
    }
    return MoveTo(&trial_, trial_cost, &trial_gradient_);
  }

  /// Moves to a feasible point already evaluated, as one iteration. Swaps its x
  /// and gradient with the current ones.
  bool MoveTo(VectorXd* at, double its_cost, VectorXd* slope) {
    x.swap(*at);
    gradient.swap(*slope);
    cost = its_cost;
    gradient_norm = gradient.norm();
    monitor.EndIteration(cost, gradient_norm, x);
    if (cost <= best_cost_) Keep();
    if (monitor.stopped()) return false;
    if (monitor.StopAtSlowProgress(cost)) return false;
    if (monitor.ReachesGradientGoal(gradient_norm, x.norm()) &&
        cost > best_cost_) {
      monitor.Stop(Termination::kNoDescent,
                   "the gradient is small, but a better point was seen");
      return false;
    }
    return !monitor.StopAtGoal(cost, gradient_norm, x.norm());
  }

  Minimum Finish() {
    return {std::move(best_), monitor.Finish(best_cost_, best_gradient_norm_)};
  }

  RunMonitor monitor;
  VectorXd x;
  VectorXd gradient;  // at x
  double cost = 0.0;
  double gradient_norm = 0.0;
  std::int64_t evaluations = 0;

 private:
  void Keep() {
    best_ = x;
    best_cost_ = cost;
    best_gradient_norm_ = gradient_norm;
  }

  const Objective& f_;
  VectorXd best_;
  VectorXd trial_;
  VectorXd trial_gradient_;
  double best_cost_ = 0.0;
  double best_gradient_norm_ = 0.0;
};

}  // namespace errmap::fitting
