#pragma once

#include <memory>

#include "fitting/minimisers/levenberg_marquardt.h"
#include "fitting/minimisers/objective.h"

namespace errmap::fitting {

/// A residual form linearised at a point x, and its damped steps: what the two
/// spaces of LevenbergMarquardt do differently.
class DampedLeastSquares {
 public:
  virtual ~DampedLeastSquares() = default;

  /// Evaluates residuals and Jacobian at x (n) and what follows from them.
  void MoveTo(const Eigen::VectorXd& x);

  double cost() const { return cost_; }
  const Eigen::VectorXd& gradient() const { return gradient_; }
  /// sum_j (|J_j| / D_j)^2 / n
  double mean_curvature() const { return mean_curvature_; }
  /// Cost and gradient are finite: steps may be asked for.
  bool is_finite() const;

  /// The run has taken x: D grows by the columns there. Until then D is that of
  /// the point the step began at, so that both are measured alike.
  virtual void Settle() {}

  /// The step (n) for a damping; false where rounding leaves none.
  virtual bool Solve(double lambda, Eigen::VectorXd* step) = 0;
  /// |D v|^2
  virtual double ScaledSquaredNorm(const Eigen::VectorXd& v) const = 0;

 protected:
  explicit DampedLeastSquares(const ResidualFunction& residuals)
      : ridge_(residuals.ridge()) {}

  const double ridge_;
  Eigen::VectorXd x_;
  Eigen::VectorXd residuals_;  // (m)
  Eigen::VectorXd gradient_;   // (n) J'r + ridge x
  double mean_curvature_ = 0.0;

 private:
  // Fills residuals, gradient and mean curvature at x_.
  virtual void Linearize() = 0;

  double cost_ = 0.0;
};

/// By Householder QR. `scale` (n), the D of kMarquardt, is set by the first
/// MoveTo and grown by every Settle; shared by the spaces of one run. Null for
/// D = I.
std::unique_ptr<DampedLeastSquares> MakeParameterSpace(
    const ResidualFunction& residuals, std::shared_ptr<Eigen::VectorXd> scale);

/// By Cholesky factorisation of J J' + mu I; D = I.
std::unique_ptr<DampedLeastSquares> MakePatternSpace(
    const ResidualFunction& residuals);

}  // namespace errmap::fitting
