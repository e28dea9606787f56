#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>

#include "fitting/minimisers/fit_summary.h"
#include "fitting/minimisers/objective.h"

namespace errmap::fitting {

/// When to stop; the report's names in brackets.
struct StoppingRules {
  /// Stop after this many accepted steps (niter); at least 0.
  std::int64_t iterations = 1500;
  /// Stop before exceeding this many evaluations of value, gradient and
  /// curvature together; at least 1.
  std::int64_t evaluations = std::numeric_limits<std::int64_t>::max();
  /// Stop once this many seconds have passed; above 0.
  double seconds = std::numeric_limits<double>::infinity();
  /// Stop when RmsError(f) < this (egoal); at least 0, and 0 never stops.
  double cost_goal = 0.0;
  /// Stop when |g| < this * max(1, |x|) (gwgoal); at least 0. The default is
  /// the report's: it stops at a true minimum only.
  double gradient_goal = 1e-12;
  /// Every `progress_interval` accepted steps (nfreq, at least 1), stop when
  /// RmsError(f) > this * its value at the last check (errdel); above 0, and
  /// infinity never stops. At 1, the report's, only growth stops. A value v
  /// below 0 has to fall likewise by (1 - this) |v|.
  double slow_ratio = std::numeric_limits<double>::infinity();
  std::int64_t progress_interval = 1;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// Where a run stands after an iteration.
struct Iterate {
  std::int64_t iteration = 0;
  double cost = 0.0;
  double gradient_norm = 0.0;
  const Eigen::VectorXd& x;  // (n) valid during the call alone
};

/// What surrounds a run without changing its mathematics.
struct RunControl {
  const std::atomic<bool>* stop = nullptr;  // set from outside to interrupt
  bool keep_trace = false;
  /// Called after every iteration; false ends the run there, as kInterrupted.
  std::function<bool(const Iterate&)> after_iteration = {};
};

struct Minimum {
  Eigen::VectorXd x;  // (n) best point seen
  FitSummary summary;
};

/// Minimises an objective from a start; immutable, shared between threads.
template <typename Scalar>
class BasicOptimizer {
 public:
  using Vector = VectorOf<Scalar>;

  virtual ~BasicOptimizer() = default;
  virtual std::string name() const = 0;

  /// Minimum found from x0 (n). Counts and times evaluations: each call of
  /// Evaluate and Value is one, and each Gradient that is new at its point. A
  /// Curvature is one, or as many gradients as its Path takes for it. Of a
  /// residual form, residuals alone count as a value, with a Jacobian as a
  /// gradient. An infeasible start (f or its gradient not finite)
  /// is reported as kFailed. Throws std::invalid_argument unless x0.size() ==
  /// f.num_parameters() and all of x0 is finite.
  Minimum Minimize(const BasicObjective<Scalar>& f,
                   const Vector& x0,
                   const RunControl& run = {}) const;

 private:
  virtual Minimum DoMinimize(const BasicObjective<Scalar>& f,
                             const Vector& x0,
                             const RunControl& run) const = 0;
};

using Optimizer = BasicOptimizer<double>;

extern template class BasicOptimizer<double>;
extern template class BasicOptimizer<float>;

}  // namespace errmap::fitting
