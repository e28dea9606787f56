#pragma once

#include <memory>

#include "stats/eigen.h"

namespace errmap::fitting {

template <typename Scalar>
using VectorOf = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// A point x of an objective that moves along directions p. It reuses values
/// that both ends of a step share (a net: its pre-activations). Made by
/// BasicObjective::NewPath; the objective must outlive it.
template <typename Scalar>
class Path {
 public:
  virtual ~Path() = default;
  /// Sets the direction p (n) for the calls that follow.
  virtual void SetDirection(const VectorOf<Scalar>& p) = 0;
  /// Returns p'Hp at x, H the Hessian; not finite if f is not.
  virtual Scalar Curvature() = 0;
  /// Number of gradient evaluations in one Curvature. It counts as that many,
  /// or as one curvature evaluation if 0.
  virtual int gradients_per_curvature() const { return 0; }
  /// Returns f(x + a p); not finite if x + a p is infeasible.
  virtual Scalar Value(Scalar a) = 0;
  /// Moves: x += a p.
  virtual void Accept(Scalar a) = 0;
  /// Returns the gradient (n) at x; valid until the next Accept.
  virtual const VectorOf<Scalar>& Gradient() = 0;
};

/// The Jacobian J (m x n) of a ResidualFunction at a point, as an operator, for
/// methods that never need J itself. Made by
/// ResidualFunction::NewLinearization; the function must outlive it.
class Linearization {
 public:
  virtual ~Linearization() = default;
  /// Moves to x (n). Fills `residuals` (m) and the lower triangle of `gram` (m
  /// x m) with J J' at x; its upper triangle is undefined.
  virtual void MoveTo(const VectorXd& x,
                      VectorXd* residuals,
                      MatrixXd* gram) = 0;
  /// Returns J v (m) for v (n), at the last x.
  virtual VectorXd Apply(const VectorXd& v) const = 0;
  /// Returns J'u (n) for u (m), at the last x.
  virtual VectorXd ApplyTransposed(const VectorXd& u) const = 0;
};

/// r(x) of f(x) = 1/2 |r(x)|^2 + 1/2 ridge |x|^2, for Gauss-Newton methods.
class ResidualFunction {
 public:
  virtual ~ResidualFunction() = default;
  virtual Index num_residuals() const = 0;
  virtual double ridge() const = 0;
  /// Fills `residuals` (m) and, unless null, `jacobian` (m x n), dr_i/dx_j.
  virtual void Evaluate(const VectorXd& x,
                        VectorXd* residuals,
                        MatrixXd* jacobian) const = 0;
  /// Returns a linearization. The default stores the Jacobian from Evaluate.
  virtual std::unique_ptr<Linearization> NewLinearization() const;
};

/// Smooth cost f(x) of n parameters: the only interface an Optimizer sees.
///
/// May keep scratch memory between calls: use one object per thread.
template <typename Scalar>
class BasicObjective {
 public:
  using Vector = VectorOf<Scalar>;
  virtual ~BasicObjective() = default;
  virtual Index num_parameters() const = 0;
  /// Returns f(x); fills `gradient` (n) unless null. A non-finite value marks x
  /// as infeasible: the optimizer then shortens its step and does not throw.
  virtual Scalar Evaluate(const Vector& x, Vector* gradient) const = 0;
  /// Returns a path that starts at x. The default uses Evaluate and computes
  /// curvature from a difference of gradients.
  virtual std::unique_ptr<Path<Scalar>> NewPath(const Vector& x) const;
  /// Returns the residual form of f, or null if there is none.
  virtual const ResidualFunction* residuals() const { return nullptr; }
};

using Objective = BasicObjective<double>;

extern template class BasicObjective<double>;
extern template class BasicObjective<float>;

}  // namespace errmap::fitting
