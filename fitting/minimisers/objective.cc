#include "fitting/minimisers/objective.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fitting/matrix_product.h"

namespace errmap::fitting {
namespace {

// Knows the objective only by its values and gradients.
template <typename Scalar>
class EvaluatedPath final : public Path<Scalar> {
 public:
  using Vector = VectorOf<Scalar>;

  EvaluatedPath(const BasicObjective<Scalar>& objective, const Vector& x)
      : objective_(objective),
        x_(x),
        p_(Vector::Zero(x.size())),
        trial_(x.size()),
        gradient_(x.size()),
        trial_gradient_(x.size()) {}

  void SetDirection(const Vector& p) override { p_ = p; }

  // Central difference of gradients along p; the step balances truncation
  // (h^2) against rounding (eps / h), relative to the size of x.
  Scalar Curvature() override {
    const Scalar length = p_.norm();
    if (!(length > Scalar(0))) return Scalar(0);
    const Scalar step = std::cbrt(std::numeric_limits<Scalar>::epsilon()) *
                        std::max(Scalar(1), x_.norm()) / length;
    trial_ = x_ + step * p_;
    objective_.Evaluate(trial_, &trial_gradient_);
    const Scalar ahead = trial_gradient_.dot(p_);
    trial_ = x_ - step * p_;
    objective_.Evaluate(trial_, &trial_gradient_);
    return (ahead - trial_gradient_.dot(p_)) / (Scalar(2) * step);
  }

  int gradients_per_curvature() const override { return 2; }

  Scalar Value(Scalar a) override {
    trial_ = x_ + a * p_;
    return objective_.Evaluate(trial_, nullptr);
  }

  void Accept(Scalar a) override {
    x_ += a * p_;
    gradient_is_current_ = false;
  }

  const Vector& Gradient() override {
    if (!gradient_is_current_) objective_.Evaluate(x_, &gradient_);
    gradient_is_current_ = true;
    return gradient_;
  }

 private:
  const BasicObjective<Scalar>& objective_;
  Vector x_;
  Vector p_;
  Vector trial_;
  Vector gradient_;
  Vector trial_gradient_;
  bool gradient_is_current_ = false;
};

// Keeps the Jacobian.
class EvaluatedLinearization final : public Linearization {
 public:
  explicit EvaluatedLinearization(const ResidualFunction& function)
      : function_(function) {}

  void MoveTo(const VectorXd& x, VectorXd* residuals, MatrixXd* gram) override {
    function_.Evaluate(x, residuals, &jacobian_);
    gram->resize(jacobian_.rows(), jacobian_.rows());
    MultiplyByOwnTranspose(jacobian_, *gram);
  }
  VectorXd Apply(const VectorXd& v) const override { return jacobian_ * v; }
  VectorXd ApplyTransposed(const VectorXd& u) const override {
    return jacobian_.transpose() * u;
  }

 private:
  const ResidualFunction& function_;
  MatrixXd jacobian_;
};

}  // namespace

std::unique_ptr<Linearization> ResidualFunction::NewLinearization() const {
  return std::make_unique<EvaluatedLinearization>(*this);
}

template <typename Scalar>
std::unique_ptr<Path<Scalar>> BasicObjective<Scalar>::NewPath(
    const Vector& x) const {
  return std::make_unique<EvaluatedPath<Scalar>>(*this, x);
}

template class BasicObjective<double>;
template class BasicObjective<float>;

}  // namespace errmap::fitting
