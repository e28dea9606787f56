#pragma once

#include <cstdint>
#include <exception>
#include <string>

#include "fitting/minimisers/run_monitor.h"

namespace errmap::fitting {

/// Stands between a third-party solver and an objective. So every solver obeys
/// the same limits and goals as ours, and reports in the same terms.
///
/// Each new point is one evaluation of value and gradient; a repeated request
/// for the last point is answered from memory. Limits are checked before each
/// evaluation, goals after it. The best point is the one of lowest cost, or of
/// smaller gradient if costs are equal. Exceptions never pass through the
/// solver: one from the objective ends the run, and the summary has its text.
/// `Finish` rethrows std::bad_alloc. Only solver iterations that find a better
/// point are counted.
class GuardedRun {
 public:
  /// The run ends after more than `patience` requests in a row without a better
  /// point, since some solvers never stop. All three references must outlive
  /// this object.
  GuardedRun(const Objective& f,
             const StoppingRules& rules,
             const RunControl& run,
             std::int64_t patience);

  /// Evaluates the start. Returns false if the run ends there.
  bool Start(const VectorXd& x0);

  /// Evaluates value and gradient at x (n numbers). Returns false if x is
  /// infeasible, or if the run has ended and the solver must stop.
  bool Evaluate(const double* x);

  /// Counts an evaluation of residuals in addition to that of Evaluate. Returns
  /// false if the limits forbid it; the run has then ended.
  bool Spend();

  /// Value and gradient of the last Evaluate that returned true, or of the
  /// start.
  double cost() const { return cost_; }
  const VectorXd& x() const { return x_; }
  const VectorXd& gradient() const { return gradient_; }

  /// True if the run has ended, for the reason that Finish reports.
  bool stopped() const { return thrown_ != nullptr || monitor_.stopped(); }

  /// Ends an iteration of the solver; it counts if it found a better point.
  void EndIteration();

  /// Call in a catch block: ends the run, unless it has ended, with the
  /// solver's exception.
  void Fail() noexcept;

  /// Returns the best point. If the solver stopped by itself, the summary says
  /// kNoDescent with `solver_text`. Throws std::bad_alloc if the run ran out of
  /// memory.
  Minimum Finish(const std::string& solver_text);

 private:
  bool EvaluateAt(const double* x);
  void EvaluateHere();
  void Keep();
  void StopByWhatWasThrown();

  const Objective& f_;
  const std::int64_t patience_;
  RunMonitor monitor_;
  VectorXd x_;
  VectorXd gradient_;
  double x_norm_ = 0.0;
  double gradient_norm_ = 0.0;
  double cost_ = 0.0;
  bool is_finite_ = false;  // at x_
  VectorXd best_;
  double best_cost_ = 0.0;
  double best_gradient_norm_ = 0.0;
  bool is_iteration_open_ = false;  // a better point since EndIteration
  std::exception_ptr thrown_;       // the exception that ended the run
  std::int64_t evaluations_ = 0;
  std::int64_t idle_ = 0;  // requests since the last better point
};

}  // namespace errmap::fitting
