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
  /// netcg: step of the difference quotient is sigma |w| / |p|; above 0.
  double sigma = 1e-4;
  /// Called after every pass if set.
  std::function<void(const ScgPass&)> observer = {};

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// Moller's scaled conjugate gradients (Neural Networks 6, 1993; NISTIR 5367,
/// section 6.5). Each pass models f along a direction p by a parabola of
/// curvature p'Hp + lambda |p|^2 and tries its minimum. It then adjusts lambda
/// to the accuracy of that prediction.
///
/// kMoller works on a Path of the objective. It needs a curvature for each
/// direction, a value for each pass and a gradient for each accepted step. The
/// first failure after a success needs another value. Six failures in a row
/// restart it from steepest descent; 61 along steepest descent end it. A step
/// to a non-finite cost or gradient is a failure; a quarter of it is tried
/// next. Before it ends, it recomputes cost and gradient at the result. A goal
/// that this does not confirm does not end the run.
///
/// kNetcg takes curvature from a difference of gradients over sigma |w| /
/// |p|. It multiplies lambda by 4 after a failure, by 16 after a poor
/// success. A third failure in a row restarts it from the gradient at the
/// rejected point.
///
/// Ends with kGradient when |g| < gradient_goal max(1, |x|), with kCostGoal,
/// kSlowProgress or a limit, or with kFailed if the start is infeasible. If no
/// step along steepest descent lowers the cost, kMoller in double ends with
/// kResolution if the cost shows a minimum (cost_resolution.h). Else the run
/// ends with kNoDescent.
template <typename Scalar>
class BasicScaledConjugateGradient final
    : public OptimizerWith<ScaledConjugateGradientOptions, Scalar> {
 public:
  using Vector = VectorOf<Scalar>;
  explicit BasicScaledConjugateGradient(ScaledConjugateGradientOptions options)
      : OptimizerWith<ScaledConjugateGradientOptions, Scalar>(
            std::move(options)) {}

  std::string name() const override { return "scg"; }

 private:
  Minimum DoMinimize(const BasicObjective<Scalar>& f,
                     const Vector& x0,
                     const RunControl& run) const override;
};

using ScaledConjugateGradient = BasicScaledConjugateGradient<double>;

extern template class BasicScaledConjugateGradient<double>;
extern template class BasicScaledConjugateGradient<float>;

}  // namespace errmap::fitting
