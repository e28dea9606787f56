#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "fitting/minimisers/optimizer.h"

namespace errmap::fitting {

/// One pass of the main loop, accepted or not; for tests and error curves.
struct ScgPass {
  std::int64_t pass = 0;
  std::int64_t iteration = 0;  // accepted steps so far
  bool accepted = false;
  double cost = 0.0;               // at the best point after the pass
  double lambda = 0.0;             // after the pass
  double alpha = 0.0;              // step length tried
  double comparison = 0.0;         // Delta_k of Eq. 107, as used
  bool made_definite = false;      // delta_k <= 0 was repaired
  bool restarted = false;          // steepest descent after n steps
  bool gave_up_direction = false;  // too many failures in a row
};

enum class ScgVariant {
  kMoller,  // Eq. 103-112 with the exact curvature p'Hp
  kNetcg,   // the report's 1995 program, choice by choice
};
std::string_view ToString(ScgVariant variant);

struct ScaledConjugateGradientOptions {
  StoppingRules stopping = {};
  ScgVariant variant = ScgVariant::kMoller;
  /// lambda_1, the first scale of the Hessian; above 0.
  double initial_lambda = 0.01;
  /// netcg: the difference quotient's step is sigma |w| / |p|; above 0.
  double sigma = 1e-4;
  /// Told of every pass if set.
  std::function<void(const ScgPass&)> observer = {};

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// Moller's scaled conjugate gradients (Neural Networks 6, 1993; NISTIR 5367,
/// section 6.5). Each pass models f along a direction p by a parabola of
/// curvature p'Hp + lambda |p|^2, tries its minimum, and moves lambda by how
/// well the parabola predicted what happened.
///
/// kMoller works on a Path of the objective: a curvature for each direction, a
/// value for each pass, another where a pass fails after one that did not, and
/// a gradient for each accepted step. Six failures in a row restart it from
/// steepest descent, 61 along steepest descent end it. A step to where cost or
/// gradient is not finite is a failure, and a quarter of it is tried next.
/// Before it ends, cost and gradient are evaluated anew at the point returned,
/// and a goal that this does not confirm does not end it.
///
/// kNetcg: curvature by a difference of gradients over sigma |w| / |p|, lambda
/// times 4 after a failure and times 16 after a poor success, a third failure
/// in a row restarts from the gradient at the rejected point.
///
/// Ends with kGradient when |g| < gradient_goal max(1, |x|), kCostGoal,
/// kSlowProgress, a limit, or kFailed where the start is infeasible. Where
/// nothing lowers the cost from steepest descent, kMoller in double ends with
/// kResolution if the cost itself says that this is a minimum
/// (cost_resolution.h), and kNoDescent says that it does not.
template <typename Scalar>
class BasicScaledConjugateGradient final : public BasicOptimizer<Scalar> {
 public:
  using Vector = VectorOf<Scalar>;

  /// Throws std::invalid_argument where the options are out of range.
  explicit BasicScaledConjugateGradient(ScaledConjugateGradientOptions options);

  std::string name() const override { return "scg"; }
  const ScaledConjugateGradientOptions& options() const { return options_; }

 private:
  Minimum DoMinimize(const BasicObjective<Scalar>& f,
                     const Vector& x0,
                     const RunControl& run) const override;

  ScaledConjugateGradientOptions options_;
};

using ScaledConjugateGradient = BasicScaledConjugateGradient<double>;

extern template class BasicScaledConjugateGradient<double>;
extern template class BasicScaledConjugateGradient<float>;

}  // namespace errmap::fitting
