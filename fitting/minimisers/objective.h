#pragma once

#include <memory>

#include <Eigen/Core>

namespace errmap::fitting {

template <typename Scalar>
using VectorOf = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// A point x of an objective moving along directions p, keeping what both ends
/// of a step share (a net: its pre-activations). Made by
/// BasicObjective::NewPath; the objective must outlive it.
template <typename Scalar>
class Path {
 public:
  virtual ~Path() = default;
  /// Direction p (n) of what follows.
  virtual void SetDirection(const VectorOf<Scalar>& p) = 0;
  /// p'Hp at x, H the Hessian; non-finite where f is.
  virtual Scalar Curvature() = 0;
  /// Gradients of f that one Curvature evaluates, which are what it counts as;
  /// 0 where it needs none and counts as one evaluation of its own.
  virtual int gradients_per_curvature() const { return 0; }
  /// f(x + a p); non-finite where x + a p is infeasible.
  virtual Scalar Value(Scalar a) = 0;
  /// x += a p.
  virtual void Accept(Scalar a) = 0;
  /// Gradient (n) at x; valid until the next Accept.
  virtual const VectorOf<Scalar>& Gradient() = 0;
};

/// The Jacobian J (m x n) of a ResidualFunction at a point, by what it does:
/// for methods that work in the space of the residuals and need J itself
/// nowhere. Made by ResidualFunction::NewLinearization, which must outlive it.
class Linearization {
 public:
  virtual ~Linearization() = default;
  /// Goes to x (n): fills `residuals` (m) and the lower triangle of `gram`
  /// (m x m), J J' at x; what stands above its diagonal is undefined.
  virtual void MoveTo(const Eigen::VectorXd& x,
                      Eigen::VectorXd* residuals,
                      Eigen::MatrixXd* gram) = 0;
  /// J v (m), v (n), at the last x.
  virtual Eigen::VectorXd Apply(const Eigen::VectorXd& v) const = 0;
  /// J'u (n), u (m), at the last x.
  virtual Eigen::VectorXd ApplyTransposed(const Eigen::VectorXd& u) const = 0;
};

/// r(x) of f(x) = 1/2 |r(x)|^2 + 1/2 ridge |x|^2, for Gauss-Newton methods.
class ResidualFunction {
 public:
  virtual ~ResidualFunction() = default;
  virtual Eigen::Index num_residuals() const = 0;
  virtual double ridge() const = 0;
  /// Fills `residuals` (m) and, unless null, `jacobian` (m x n), dr_i/dx_j.
  virtual void Evaluate(const Eigen::VectorXd& x,
                        Eigen::VectorXd* residuals,
                        Eigen::MatrixXd* jacobian) const = 0;
  /// The default keeps the Jacobian of Evaluate.
  virtual std::unique_ptr<Linearization> NewLinearization() const;
};

/// Smooth cost f(x) of n parameters: all that an Optimizer ever sees.
///
/// May keep scratch memory between calls: use one object per thread.
template <typename Scalar>
class BasicObjective {
 public:
  using Vector = VectorOf<Scalar>;
  virtual ~BasicObjective() = default;
  virtual Eigen::Index num_parameters() const = 0;
  /// Returns f(x); fills `gradient` (n) unless null. A non-finite value marks
  /// x infeasible: the optimizer shortens its step, nothing throws.
  virtual Scalar Evaluate(const Vector& x, Vector* gradient) const = 0;
  /// A point starting at x. The default goes through Evaluate and takes
  /// curvature from a difference of gradients.
  virtual std::unique_ptr<Path<Scalar>> NewPath(const Vector& x) const;
  /// The residual form of f, or null where there is none.
  virtual const ResidualFunction* residuals() const { return nullptr; }
};

using Objective = BasicObjective<double>;

extern template class BasicObjective<double>;
extern template class BasicObjective<float>;

}  // namespace errmap::fitting
