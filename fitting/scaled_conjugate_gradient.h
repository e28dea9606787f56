#pragma once

#include <cstdint>
#include <functional>

#include "fitting/optimizer.h"

namespace errmap::fitting {

/// One pass of the main loop, accepted or not; for tests and error curves.
struct ScgPass {
  std::int64_t pass = 0;
  std::int64_t iteration = 0;  // accepted steps so far
  bool accepted = false;
  double cost = 0.0;               // at the best point after the pass
  double lambda = 0.0;             // after the pass
  double alpha = 0.0;              // step length tried
  double comparison = 0.0;         // Delta_k of step 5, as used
  bool made_definite = false;      // delta_k <= 0 was repaired
  bool restarted = false;          // steepest descent after n steps
  bool gave_up_direction = false;  // third failure in a row
};

struct ScaledConjugateGradientOptions {
  StoppingRules stopping = {};
  /// lambda_1, the first scale of the Hessian; above 0.
  double initial_lambda = 0.01;
  /// The difference quotient's step is sigma |w| / |p|; above 0.
  double sigma = 1e-4;
  /// Told of every pass if set.
  std::function<void(const ScgPass&)> observer = {};

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// Moller's scaled conjugate gradients (NISTIR 5367, section 6.5, Eq. 103-112)
/// with the choices of the report's 1995 program: curvature by a difference of
/// gradients over sigma |w| / |p|, lambda from 0.01, times 4 after a failure
/// and times 16 after a poor success, a third failure in a row restarts from
/// the gradient at the rejected point, steepest descent every n steps.
///
/// Ends with kGradient when |g| < gradient_goal max(1, |x|), kCostGoal,
/// kSlowProgress, kNoDescent (three failures straight after a restart), a
/// limit, or kFailed where the start is infeasible.
class ScaledConjugateGradient final : public Optimizer {
 public:
  /// Throws std::invalid_argument where the options are out of range.
  explicit ScaledConjugateGradient(ScaledConjugateGradientOptions options);

  std::string name() const override { return "scg"; }
  const ScaledConjugateGradientOptions& options() const { return options_; }

 private:
  Minimum DoMinimize(const Objective& f,
                     const Eigen::VectorXd& x0,
                     const RunControl& run) const override;

  ScaledConjugateGradientOptions options_;
};

}  // namespace errmap::fitting
