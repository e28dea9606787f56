#pragma once

#include <functional>

#include "fitting/minimisers/objective.h"

namespace errmap::fitting {

struct Derivative {
  double value = 0.0;
  double error = 0.0;  // estimate of the absolute error of `value`
};

/// Returns df/dt at `t` by Ridders' method (1982): central differences with
/// decreasing steps, extrapolated to zero, until the error estimate grows.
/// `step` is the first and largest step, over which f should change noticeably.
Derivative RiddersDerivative(const std::function<double(double)>& f,
                             double t,
                             double step);

struct GradientCheck {
  double worst_relative_error = 0.0;  // |analytic - numeric| / scale
  Index worst_parameter = -1;
  double worst_analytic = 0.0;
  double worst_numeric = 0.0;
};

/// Compares the gradient of `f` at x (n) with Ridders' derivatives for every
/// parameter. Errors are relative to max(|numeric|, 1e-6 times the largest
/// gradient component), since a component near zero gives no useful scale.
GradientCheck CheckGradient(const Objective& f,
                            const VectorXd& x,
                            double step = 0.1);

}  // namespace errmap::fitting
