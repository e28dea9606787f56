#pragma once

#include <memory>

#include "fitting/minimisers/objective.h"

namespace errmap::fitting {

/// A residual form linearised at a point x, and its damped steps. The two
/// spaces of LevenbergMarquardt implement it differently.
class DampedLeastSquares {
 public:
  virtual ~DampedLeastSquares() = default;

  /// Evaluates residuals and Jacobian at x (n) and the derived quantities.
  void MoveTo(const VectorXd& x);

  double cost() const { return cost_; }
  const VectorXd& gradient() const { return gradient_; }
  /// sum_j (|J_j| / D_j)^2 / n
  double mean_curvature() const { return mean_curvature_; }
  /// True if cost and gradient are finite, so that steps may be computed.
  bool is_finite() const;

  /// Called once the run accepts x: updates D by its columns. Until then D is
  /// that of the step's starting point, so both points use the same metric.
  virtual void Settle() {}

  /// Computes the step (n) for a damping; false if rounding leaves none.
  virtual bool Solve(double lambda, VectorXd* step) = 0;
  /// |D v|^2
  virtual double ScaledSquaredNorm(const VectorXd& v) const = 0;

 protected:
  explicit DampedLeastSquares(const ResidualFunction& residuals)
      : ridge_(residuals.ridge()) {}

  const double ridge_;
  VectorXd x_;
  VectorXd residuals_;  // (m)
  VectorXd gradient_;   // (n) J'r + ridge x
  double mean_curvature_ = 0.0;

 private:
  // Fills residuals, gradient and mean curvature at x_.
  virtual void Linearize() = 0;

  double cost_ = 0.0;
};

/// Creates the solver by Householder QR. `scale` (n) is the D of kMarquardt,
/// set by the first MoveTo, increased by Settle, and shared by the spaces of
/// one run. Null for D = I.
std::unique_ptr<DampedLeastSquares> MakeParameterSpace(
    const ResidualFunction& residuals, std::shared_ptr<VectorXd> scale);

/// Creates the solver by Cholesky factorisation of J J' + mu I; D = I.
std::unique_ptr<DampedLeastSquares> MakePatternSpace(
    const ResidualFunction& residuals);

}  // namespace errmap::fitting
