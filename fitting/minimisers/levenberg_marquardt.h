#pragma once

#include <string>

#include "fitting/minimisers/optimizer.h"

namespace errmap::fitting {

/// Scaling D of the damping term lambda |D p|^2.
enum class LmScaling {
  kNone,  // D = I
  // D_j = the largest |J_j| of the points accepted so far (More 1978), 1 if
  // that is 0. A trial is judged by the D of the point it starts from.
  kMarquardt,
};

/// Space in which the damped problem is solved; m residuals, n parameters.
enum class LmSpace {
  kAuto,        // patterns if m < n and scaling is kNone, else parameters
  kParameters,  // Householder QR of [J; sqrt(c) I; sqrt(lambda) D]
  kPatterns,    // Cholesky of J J' + (c + lambda) I
};

struct LevenbergMarquardtOptions {
  StoppingRules stopping = {.iterations = 200};
  /// The first lambda is this times the mean of (|J_j| / D_j)^2 over the
  /// parameters; above 0. Compared with 1e-3 and 0.1, the default needed the
  /// fewest trials on nets of 2341 weights. For curve fits from poor starts, 1
  /// to 100 is safer.
  double initial_damping = 1e-2;
  /// kMarquardt makes the iterations independent of the parameters' units.
  LmScaling scaling = LmScaling::kNone;
  /// Ends, without claiming a minimum, if |D p| <= this |D x|. At least 0; at 0
  /// it ends only when x + p == x.
  double step_tolerance = 0.0;
  /// Relative difference below which costs are not compared by value alone; in
  /// [0, 1). A sum of squared differences of large numbers has few correct
  /// digits; the gradient at a minimum has many.
  double cost_resolution = 1e-10;
  LmSpace space = LmSpace::kAuto;

  /// Throws std::invalid_argument naming field, value and range, and for
  /// kPatterns with kMarquardt.
  void Validate() const;
};

/// Levenberg-Marquardt for f = 1/2 |r|^2 + 1/2 c |x|^2 in residual form, with J
/// the Jacobian of r and g = J'r + c x. The step p minimises
///
///   1/2 |r + J p|^2 + 1/2 c |x + p|^2 + 1/2 lambda |D p|^2.
///
/// The first two terms fall by predicted = 1/2 p'(lambda D^2 p - g). With rho =
/// (f(x) - f(x + p)) / predicted, p is accepted if rho > 1e-4; then lambda *=
/// max(1/3, 1 - (2 rho - 1)^3), nu = 2. If not, or if f(x + p) or the gradient
/// there is not finite, lambda *= nu, nu *= 2 (Nielsen 1999, IMM-REP-1999-05).
///
/// If predicted <= cost_resolution f, differences of costs are mostly rounding.
/// p is then accepted if the cost falls as above by more than rounding, or
/// changes by at most cost_resolution f while e = g'(J'J + c I + lambda D^2)^-1
/// g falls; lambda /= 3 if e falls below a quarter. Costs alone give 8 digits;
/// this gives the digits of the gradient.
///
/// In pattern space, with mu = c + lambda,
///   (J J' + mu I) u = -(r - (c / mu) J x),  p = -(c / mu) x + J'u,
/// so a step costs m^3 / 3 instead of n^3 / 3 operations. In parameter space
/// the triangle of [J; sqrt(c) I] is computed once per point, by Householder
/// transformations and never from J'J, and completed by sqrt(lambda) D for
/// every lambda: 2 m n^2 operations a point, 2 n^3 a trial.
///
/// A trial costs one evaluation of residuals. A trial that may be accepted
/// costs another, with the Jacobian.
///
/// Ends with kGradient if both J'r + c x and the objective's own gradient
/// satisfy |g| < gradient_goal max(1, |x|). Gives up if steps vanish
/// (step_tolerance), lambda overflows, or below cost_resolution neither f nor e
/// falls in ten trials. It then ends with kResolution if the cost shows a
/// minimum (cost_resolution.h), else with kNoDescent. Also ends at the limits
/// and goals of StoppingRules. If residual form and objective give different
/// costs at x0, it ends with kFailed. If they differ later, it ends with
/// kNoDescent, at the last point or at x0, whichever has the lower objective.
/// Final cost and gradient are those of the objective, evaluated again at the
/// end.
class LevenbergMarquardt final
    : public OptimizerWith<LevenbergMarquardtOptions> {
 public:
  explicit LevenbergMarquardt(LevenbergMarquardtOptions options)
      : OptimizerWith(options) {}

  std::string name() const override { return "lm"; }

 private:
  // Throws std::invalid_argument if f has no residual form or a ridge < 0.
  Minimum DoMinimize(const Objective& f,
                     const VectorXd& x0,
                     const RunControl& run) const override;
};

}  // namespace errmap::fitting
