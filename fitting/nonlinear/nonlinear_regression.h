#pragma once

#include <vector>

#include "fitting/least_squares/extended_least_squares.h"
#include "fitting/minimisers/objective.h"
#include "fitting/minimisers/optimizer.h"
#include "fitting/nonlinear/dual_number.h"
#include "stats/eigen.h"

namespace errmap::fitting {

/// Residuals r_i = y_i - f(x_i, b) of a model with p parameters b and n
/// observations, in double and in 106 bits.
class RegressionFunction {
 public:
  virtual ~RegressionFunction() = default;
  virtual Index num_parameters() const = 0;
  virtual Index num_observations() const = 0;
  /// Indices of parameters in which f is jointly linear if the others are
  /// fixed.
  virtual std::vector<Index> linear_parameters() const { return {}; }
  /// Fills `residuals` (n) and, unless null, `jacobian` (n x p), dr_i/db_j.
  virtual void Evaluate(const VectorXd& b,
                        VectorXd* residuals,
                        MatrixXd* jacobian) const = 0;
  virtual void Evaluate(const ExtendedVector& b,
                        ExtendedVector* residuals,
                        ExtendedMatrix* jacobian) const = 0;
};

/// A RegressionFunction from one formula, with its Jacobian by automatic
/// differentiation. `Formula` has kParameters and, for every T that is a number
/// or a Dual of one,
///   template <typename T, typename X> static T Predict(const T* b, const X*
///   x);
/// kLinear, an array of indices, names linear_parameters() if there are any.
template <typename Formula>
class FormulaRegression final : public RegressionFunction {
 public:
  /// `predictors` (n x k): one row x per observation; `target` (n).
  FormulaRegression(ExtendedMatrix predictors, ExtendedVector target)
      : predictors_(predictors.transpose()),
        target_(std::move(target)),
        double_predictors_(predictors_.cast<double>()),
        double_target_(target_.cast<double>()) {}

  Index num_parameters() const override { return Formula::kParameters; }
  Index num_observations() const override { return target_.size(); }
  std::vector<Index> linear_parameters() const override {
    if constexpr (requires { Formula::kLinear; }) {
      return {std::begin(Formula::kLinear), std::end(Formula::kLinear)};
    } else {
      return {};
    }
  }
  void Evaluate(const VectorXd& b,
                VectorXd* residuals,
                MatrixXd* jacobian) const override {
    EvaluateIn<double>(
        double_predictors_, double_target_, b, residuals, jacobian);
  }
  void Evaluate(const ExtendedVector& b,
                ExtendedVector* residuals,
                ExtendedMatrix* jacobian) const override {
    EvaluateIn<stats::DoubleDouble>(
        predictors_, target_, b, residuals, jacobian);
  }

 private:
  template <typename Scalar, typename Matrix, typename Vector>
  static void EvaluateIn(const Matrix& predictors,
                         const Vector& target,
                         const Vector& b,
                         Vector* residuals,
                         Matrix* jacobian) {
    constexpr int kParameters = Formula::kParameters;
    using Derived = Dual<Scalar, kParameters>;
    residuals->resize(target.size());
    if (jacobian == nullptr) {
      for (Index i = 0; i < target.size(); ++i) {
        (*residuals)[i] =
            target[i] - Formula::Predict(b.data(), predictors.col(i).data());
      }
      return;
    }
    jacobian->resize(target.size(), kParameters);
    std::array<Derived, static_cast<std::size_t>(kParameters)> parameters;
    for (int j = 0; j < kParameters; ++j) {
      parameters[static_cast<std::size_t>(j)] = Derived::Parameter(b[j], j);
    }
    for (Index i = 0; i < target.size(); ++i) {
      const Derived prediction =
          Formula::Predict(parameters.data(), predictors.col(i).data());
      (*residuals)[i] = target[i] - prediction.value;
      for (int j = 0; j < kParameters; ++j) {
        (*jacobian)(i, j) = -prediction.slope[static_cast<std::size_t>(j)];
      }
    }
  }

  ExtendedMatrix predictors_;  // (k x n)
  ExtendedVector target_;
  MatrixXd double_predictors_;
  VectorXd double_target_;
};

/// f(b) = 1/2 |r(b)|^2 as an Objective for optimizers. `function` must outlive
/// it.
class RegressionObjective : public Objective, protected ResidualFunction {
 public:
  explicit RegressionObjective(const RegressionFunction& function)
      : function_(function) {}

  Index num_parameters() const override { return function_.num_parameters(); }
  double Evaluate(const VectorXd& b, VectorXd* gradient) const final;
  const ResidualFunction* residuals() const final { return this; }

 protected:
  const RegressionFunction& function() const { return function_; }
  Index num_residuals() const final { return function_.num_observations(); }
  double ridge() const final { return 0.0; }
  void Evaluate(const VectorXd& b,
                VectorXd* residuals,
                MatrixXd* jacobian) const override {
    function_.Evaluate(b, residuals, jacobian);
  }

 private:
  const RegressionFunction& function_;
};

/// Results of a regression at given parameters, computed in 106 bits.
struct RegressionStatistics {
  VectorXd parameters;  // (p)
  /// sqrt(s^2 [(J'J)^-1]_jj), s^2 = RSS / (n - p); NaN if J is rank deficient.
  VectorXd standard_deviations;
  double residual_sum_of_squares = 0.0;
  Index degrees_of_freedom = 0;
};

/// Computes them. Throws std::invalid_argument unless b has size p and n > p.
RegressionStatistics AssessRegression(const RegressionFunction& function,
                                      const ExtendedVector& b);

struct PolishedParameters {
  ExtendedVector parameters;  // (p)
  int steps = 0;
  bool converged = false;  // no parameter would change any more
};

/// Takes Gauss-Newton steps from `b` (p) in 106 bits, each halved until it
/// lowers the sum of squares. This gains digits that a minimiser in double
/// cannot reach, since there the sum is flat within the root of the rounding
/// unit. Ends if no step lowers the sum, or if J is rank deficient.
PolishedParameters PolishRegression(const RegressionFunction& function,
                                    const ExtendedVector& b);

struct RegressionFit {
  RegressionStatistics statistics;
  FitSummary summary;  // of the best run; its message names the strategy
};

/// Minimises `function` from `start` (p) by Levenberg-Marquardt with several
/// strategies: scalings, first dampings, and the ProjectedObjective if there
/// are linear parameters. Polishes the result with the lowest sum of squares.
/// Every strategy always runs, since a curved valley may stop one but not the
/// next. Ends with kGradient if polishing converged, else as the best run did.
/// Throws std::invalid_argument as Optimizer::Minimize does.
RegressionFit FitNonlinearRegression(const RegressionFunction& function,
                                     const VectorXd& start,
                                     const StoppingRules& stopping);

}  // namespace errmap::fitting
