#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "fitting/minimisers/fit_summary.h"
#include "fitting/minimisers/objective.h"

namespace errmap::fitting {

/// Rules for stopping; the report's names are in brackets.
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
  /// that of the report: it stops only at a true minimum.
  double gradient_goal = 1e-12;
  /// Every `progress_interval` accepted steps (nfreq, at least 1), stop when
  /// RmsError(f) > this * its value at the last check (errdel). Above 0;
  /// infinity never stops. At 1, as in the report, only growth stops. A value v
  /// below 0 must fall by (1 - this) |v|.
  double slow_ratio = std::numeric_limits<double>::infinity();
  std::int64_t progress_interval = 1;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// State of a run after an iteration.
struct Iterate {
  std::int64_t iteration = 0;
  double cost = 0.0;
  double gradient_norm = 0.0;
  const VectorXd& x;  // (n) valid only during the call
};

/// Control of a run that does not change its mathematics.
struct RunControl {
  const std::atomic<bool>* stop = nullptr;  // set from outside to interrupt
  bool keep_trace = false;
  /// Called after every iteration; false ends the run as kInterrupted.
  std::function<bool(const Iterate&)> after_iteration = {};
};

struct Minimum {
  VectorXd x;  // (n) best point seen
  FitSummary summary;
};

/// Minimises an objective from a start; immutable, may be shared by threads.
template <typename Scalar>
class BasicOptimizer {
 public:
  using Vector = VectorOf<Scalar>;

  virtual ~BasicOptimizer() = default;
  virtual std::string name() const = 0;

  /// Returns the minimum found from x0 (n). Counts and times evaluations. Each
  /// call of Evaluate and Value counts as one, and each Gradient at a new
  /// point. A Curvature counts as one, or as the gradients its Path evaluates.
  /// Residuals alone count as a value, with a Jacobian as a gradient. An
  /// infeasible start (f or its gradient not finite) is reported as kFailed.
  /// Throws std::invalid_argument unless x0.size() == f.num_parameters() and x0
  /// is finite.
  Minimum Minimize(const BasicObjective<Scalar>& f,
                   const Vector& x0,
                   const RunControl& run = {}) const;

 private:
  virtual Minimum DoMinimize(const BasicObjective<Scalar>& f,
                             const Vector& x0,
                             const RunControl& run) const = 0;
};

using Optimizer = BasicOptimizer<double>;

/// A minimiser with options of its own.
template <typename Options, typename Scalar = double>
class OptimizerWith : public BasicOptimizer<Scalar> {
 public:
  /// Throws std::invalid_argument if an option is out of range.
  explicit OptimizerWith(Options options) : options_(std::move(options)) {
    options_.Validate();
  }

 protected:
  Options options_;
};

extern template class BasicOptimizer<double>;
extern template class BasicOptimizer<float>;

}  // namespace errmap::fitting
