#pragma once

#include <string>

#include "fitting/minimisers/optimizer.h"

namespace errmap::fitting {

/// The metric D of the damping term lambda |D p|^2.
enum class LmScaling {
  kNone,  // D = I
  // D_j = the largest |J_j| of the points taken so far (More 1978), 1 where it
  // is 0; a trial is judged by the D of the point that it started from.
  kMarquardt,
};

/// Where the damped problem is solved; m residuals, n parameters.
enum class LmSpace {
  kAuto,        // patterns where m < n and scaling is kNone, else parameters
  kParameters,  // Householder QR of [J; sqrt(c) I; sqrt(lambda) D]
  kPatterns,    // Cholesky of J J' + (c + lambda) I
};

struct LevenbergMarquardtOptions {
  StoppingRules stopping = {.iterations = 200};
  /// The first lambda is this times the mean of (|J_j| / D_j)^2 over the
  /// parameters; above 0. Of 1e-3, 1e-2 and 0.1 this one took the fewest trials
  /// on nets of 2341 weights; from poor starts of curve fits 1 to 100 is safer.
  double initial_damping = 1e-2;
  /// kMarquardt makes the iterations independent of the parameters' units.
  LmScaling scaling = LmScaling::kNone;
  /// Ends without a claim where |D p| <= this |D x|; at least 0, and 0 goes on
  /// until x + p == x.
  double step_tolerance = 0.0;
  /// Costs nearer to each other than this, relative, are not told apart by
  /// their values alone; in [0, 1). A cost that is a sum of squared differences
  /// of large numbers has few digits, the gradient at a minimum many.
  double cost_resolution = 1e-10;
  LmSpace space = LmSpace::kAuto;

  /// Throws std::invalid_argument naming field, value and range, and for
  /// kPatterns with kMarquardt.
  void Validate() const;
};

/// Levenberg-Marquardt for f = 1/2 |r|^2 + 1/2 c |x|^2 in residual form, J the
/// Jacobian of r and g = J'r + c x. The step p minimises
///
///   1/2 |r + J p|^2 + 1/2 c |x + p|^2 + 1/2 lambda |D p|^2,
///
/// whose first two terms fall by predicted = 1/2 p'(lambda D^2 p - g). With
/// rho = (f(x) - f(x + p)) / predicted, p is accepted where rho > 1e-4, and
/// lambda *= max(1/3, 1 - (2 rho - 1)^3), nu = 2; else, and where f(x + p) or
/// the gradient there is not finite, lambda *= nu, nu *= 2 (Nielsen 1999,
/// IMM-REP-1999-05).
///
/// Where predicted <= cost_resolution f, differences of costs are mostly
/// rounding: p is then accepted where the cost falls by more than rounding as
/// above, or changes by no more than cost_resolution f while
/// e = g'(J'J + c I + lambda D^2)^-1 g falls; lambda /= 3 where e falls below a
/// quarter. This turns the 8 digits that costs can give into those of the
/// gradient.
///
/// In pattern space, with mu = c + lambda,
///   (J J' + mu I) u = -(r - (c / mu) J x),  p = -(c / mu) x + J'u,
/// so that a step costs m^3 / 3 and not n^3 / 3 operations. In parameter space
/// the triangle of [J; sqrt(c) I] is made once a point, by Householder
/// transformations and never from J'J, and completed by sqrt(lambda) D for
/// every lambda: 2 m n^2 operations a point, 2 n^3 a trial.
///
/// A trial costs an evaluation of residuals alone, one that may be accepted
/// another with the Jacobian.
///
/// Ends with kGradient where both J'r + c x and the objective's own gradient
/// satisfy |g| < gradient_goal max(1, |x|). Where steps vanish
/// (step_tolerance), lambda overflows, or below cost_resolution neither f nor e
/// falls in ten trials: with kResolution if the cost itself says that this is a
/// minimum (cost_resolution.h), else with kNoDescent. At the limits and goals
/// of StoppingRules. Where residual form and objective give different costs:
/// with kFailed at x0, later with kNoDescent at the end or at x0, whichever the
/// objective says is lower. Final cost and gradient are the objective's own,
/// evaluated again at the end.
class LevenbergMarquardt final : public Optimizer {
 public:
  /// Throws std::invalid_argument where the options are out of range.
  explicit LevenbergMarquardt(LevenbergMarquardtOptions options);

  std::string name() const override { return "lm"; }

 private:
  // Throws std::invalid_argument where f has no residual form.
  Minimum DoMinimize(const Objective& f,
                     const Eigen::VectorXd& x0,
                     const RunControl& run) const override;

  LevenbergMarquardtOptions options_;
};

}  // namespace errmap::fitting
