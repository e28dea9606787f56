#pragma once

#include <cstdint>
#include <exception>
#include <string>

#include "fitting/minimisers/run_monitor.h"

namespace errmap::fitting {

/// Stands between a foreign solver and an objective, so that every solver is
/// held to the same limits, goals and words as our own.
///
/// Each new point is one evaluation of value and gradient together; asked again
/// for the point it has just answered, it answers from memory. Limits are asked
/// before each evaluation, goals after it. The best point seen is kept: the
/// lowest cost, of equal ones that with the smaller gradient. Nothing
/// is thrown through the solver: what the objective throws ends the run with
/// its text; want of memory, after which there is no result, is thrown again by
/// Finish. An iteration is one of the solver's that found a better point.
class GuardedRun {
 public:
  /// After more than `patience` requests in a row that bring no lower cost, the
  /// run is over: some solvers never notice. All three references must outlive
  /// this.
  GuardedRun(const Objective& f,
             const StoppingRules& rules,
             const RunControl& run,
             std::int64_t patience);

  /// Evaluates the start; false where the run ends there.
  bool Start(const Eigen::VectorXd& x0);

  /// Value and gradient at x (n numbers). False where there are none: x is
  /// infeasible, or the run is over and the solver has to come to its end.
  bool Evaluate(const double* x);

  /// One more evaluation is about to be made beside Evaluate's, of residuals;
  /// false where the limits forbid it, and the run is over.
  bool Spend();

  /// Of the last Evaluate that returned true, or of the start.
  double cost() const { return cost_; }
  const Eigen::VectorXd& x() const { return x_; }
  const Eigen::VectorXd& gradient() const { return gradient_; }

  /// The run is over, for the reason that Finish reports.
  bool stopped() const { return thrown_ != nullptr || monitor_.stopped(); }

  /// The solver has ended an iteration, counted if the cost has fallen in it.
  void EndIteration();

  /// Ends the run, unless it is over, by the exception that is being handled:
  /// "what the solver threw".
  void Fail() noexcept;

  /// The best point. Where the run was not ended here, the solver gave up by
  /// itself: kNoDescent with its own words in `solver_text`. Throws
  /// std::bad_alloc where the run found not enough memory.
  Minimum Finish(const std::string& solver_text);

 private:
  bool EvaluateAt(const double* x);
  void EvaluateHere();
  void Keep();
  void StopByWhatWasThrown();

  const Objective& f_;
  const std::int64_t patience_;
  RunMonitor monitor_;
  Eigen::VectorXd x_;
  Eigen::VectorXd gradient_;
  double x_norm_ = 0.0;
  double gradient_norm_ = 0.0;
  double cost_ = 0.0;
  bool is_finite_ = false;  // at x_
  Eigen::VectorXd best_;
  double best_cost_ = 0.0;
  double best_gradient_norm_ = 0.0;
  bool is_iteration_open_ = false;  // the cost fell since the last EndIteration
  std::exception_ptr thrown_;       // what ended the run
  std::int64_t evaluations_ = 0;
  std::int64_t idle_ = 0;  // requests since the cost last fell
  std::int64_t steps_since_check_ = 0;
};

}  // namespace errmap::fitting
