#include "fitting/minimisers/damped_least_squares.h"

#include <cmath>
#include <utility>

#include "fitting/interruption.h"
#include "fitting/least_squares/triangular_reduction.h"
#include "fitting/matrix_product.h"

namespace errmap::fitting {
namespace {

// Works in q = D p, on J D^-1: damping then is a multiple of the identity, and
// columns of any size are of one.
class ParameterSpace final : public DampedLeastSquares {
 public:
  ParameterSpace(const ResidualFunction& residuals,
                 std::shared_ptr<VectorXd> scale)
      : DampedLeastSquares(residuals),
        function_(residuals),
        largest_(std::move(scale)) {}

  bool Solve(double lambda, VectorXd* step) override {
    const Index n = x_.size();
    damped_ = triangle_;
    extra_.setZero(n, n + 1);
    extra_.diagonal().setConstant(std::sqrt(lambda));
    FoldIntoTriangle(&damped_, extra_);
    if (!(damped_.diagonal().head(n).cwiseAbs().minCoeff() > 0.0)) return false;
    *step = -damped_.topLeftCorner(n, n).triangularView<Eigen::Upper>().solve(
        damped_.col(n).head(n));
    if (scale_.size() != 0) step->array() /= scale_.array();
    return step->allFinite();
  }

  void Settle() override {
    if (largest_ == nullptr) return;
    *largest_ = largest_->cwiseMax(norms_);
    const VectorXd grown = Scale();
    triangle_.leftCols(grown.size()) *=
        scale_.cwiseQuotient(grown).asDiagonal();
    scale_ = grown;
  }

  double ScaledSquaredNorm(const VectorXd& v) const override {
    return scale_.size() == 0 ? v.squaredNorm()
                              : scale_.cwiseProduct(v).squaredNorm();
  }

 private:
  VectorXd Scale() const {
    return (largest_->array() > 0.0).select(*largest_, 1.0);
  }

  void Linearize() override {
    const Index n = x_.size();
    MatrixXd jacobian;
    ThrowIfInterrupted();
    function_.Evaluate(x_, &residuals_, &jacobian);
    ThrowIfInterrupted();
    gradient_ = jacobian.transpose() * residuals_;
    gradient_ += ridge_ * x_;
    if (largest_ != nullptr) {
      norms_ = (jacobian.colwise().squaredNorm().transpose().array() + ridge_)
                   .sqrt();
      if (!norms_.allFinite()) {
        gradient_.setConstant(n, norms_.sum());
        return;
      }
      if (largest_->size() == 0) *largest_ = norms_;
      scale_ = Scale();
      jacobian *= scale_.cwiseInverse().asDiagonal();
    }
    mean_curvature_ = jacobian.squaredNorm() / static_cast<double>(n);
    ThrowIfInterrupted();
    jacobian.conservativeResize(Eigen::NoChange, n + 1);
    jacobian.col(n) = residuals_;
    triangle_.setZero(n + 1, n + 1);
    FoldIntoTriangle(&triangle_, jacobian);
    if (ridge_ > 0.0) {
      const double root = std::sqrt(ridge_);
      extra_.setZero(n, n + 1);
      extra_.diagonal().setConstant(root);
      if (scale_.size() != 0) {
        extra_.diagonal().array() /= scale_.array();
      }
      extra_.col(n) = root * x_;
      FoldIntoTriangle(&triangle_, extra_);
    }
  }

  const ResidualFunction& function_;
  std::shared_ptr<VectorXd> largest_;  // |J_j| where the run has been, or null
  VectorXd norms_;                     // |J_j| here
  VectorXd scale_;                     // D (n), or (0)
  MatrixXd triangle_;  // R of [J D^-1, r; sqrt(c) D^-1, sqrt(c) x]
  MatrixXd damped_;
  MatrixXd extra_;
};

class PatternSpace final : public DampedLeastSquares {
 public:
  explicit PatternSpace(const ResidualFunction& residuals)
      : DampedLeastSquares(residuals),
        linearization_(residuals.NewLinearization()) {}

  bool Solve(double lambda, VectorXd* step) override {
    const double mu = ridge_ + lambda;
    factor_.resize(gram_.rows(), gram_.cols());
    factor_.triangularView<Eigen::Lower>() = gram_;
    factor_.diagonal().array() += mu;
    if (!(mu > 0.0) || !FactorizeCholesky(factor_)) return false;
    u_ = -residuals_;
    if (ridge_ > 0.0) u_ += (ridge_ / mu) * along_x_;
    SolveCholesky(factor_, &u_);
    *step = linearization_->ApplyTransposed(u_);
    *step -= (ridge_ / mu) * x_;
    return step->allFinite();
  }

  double ScaledSquaredNorm(const VectorXd& v) const override {
    return v.squaredNorm();
  }

 private:
  void Linearize() override {
    linearization_->MoveTo(x_, &residuals_, &gram_);
    gradient_ = linearization_->ApplyTransposed(residuals_);
    gradient_ += ridge_ * x_;
    if (ridge_ > 0.0) along_x_ = linearization_->Apply(x_);
    mean_curvature_ = gram_.diagonal().sum() / static_cast<double>(x_.size());
  }

  std::unique_ptr<Linearization> linearization_;
  MatrixXd gram_;     // J J', lower triangle
  MatrixXd factor_;   // L
  VectorXd along_x_;  // J x
  VectorXd u_;
};

}  // namespace

void DampedLeastSquares::MoveTo(const VectorXd& x) {
  x_ = x;
  Linearize();
  cost_ = 0.5 * residuals_.squaredNorm() + 0.5 * ridge_ * x_.squaredNorm();
}

bool DampedLeastSquares::is_finite() const {
  return std::isfinite(cost_) && gradient_.allFinite() &&
         std::isfinite(mean_curvature_);
}

std::unique_ptr<DampedLeastSquares> MakeParameterSpace(
    const ResidualFunction& residuals, std::shared_ptr<VectorXd> scale) {
  return std::make_unique<ParameterSpace>(residuals, std::move(scale));
}

std::unique_ptr<DampedLeastSquares> MakePatternSpace(
    const ResidualFunction& residuals) {
  return std::make_unique<PatternSpace>(residuals);
}

}  // namespace errmap::fitting
