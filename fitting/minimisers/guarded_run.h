#pragma once

#include <cstdint>
#include <exception>
#include <string>

#include "fitting/minimisers/run_monitor.h"

namespace errmap::fitting {

/// Stands between a foreign solver and an objective: every solver then obeys
/// the limits and goals of our own, and reports in the same terms.
///
/// Each new point is one evaluation of value and gradient; a repeated request
/// for the last point is answered from memory. Limits are checked before each
/// evaluation, goals after it. The best point is kept: the lowest cost, among
/// equal ones the smaller gradient. Exceptions never pass through the solver:
/// one from the objective ends the run, with its text. `Finish` rethrows
/// std::bad_alloc. An iteration is a solver iteration that found a better
/// point.
class GuardedRun {
 public:
  /// The run ends after more than `patience` requests in a row without a better
  /// point, since some solvers never notice. All three references must outlive
  /// this object.
  GuardedRun(const Objective& f,
             const StoppingRules& rules,
             const RunControl& run,
             std::int64_t patience);

  /// Evaluates the start. Returns false if the run ends there.
  bool Start(const VectorXd& x0);

  /// Evaluates value and gradient at x (n numbers). Returns false if there are
  /// none: x is infeasible, or the run has ended and the solver must stop.
  bool Evaluate(const double* x);

  /// Counts one more evaluation, of residuals, besides that of Evaluate.
  /// Returns false if the limits forbid it; the run has then ended.
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

  /// Ends the run, unless it has ended, by the exception being handled: an
  /// exception of the solver.
  void Fail() noexcept;

  /// Returns the best point. If the solver gave up by itself, the summary says
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
