#pragma once

#include <vector>

#include <Eigen/Core>

#include "fitting/nonlinear/nonlinear_regression.h"

namespace errmap::fitting {

/// A regression with its conditionally linear parameters c eliminated: for
/// given others, a, they are the least squares solution, so that
///
///   f(a) = min over c of 1/2 |r(a, c)|^2
///
/// (Golub & Pereyra, SIAM J. Numer. Anal. 10, 1973). The Jacobian is Kaufman's
/// (BIT 15, 1975): that of r in a, projected onto the complement of the columns
/// of c. Its J'r is the exact gradient. A bad guess of c does no harm.
/// `function` must outlive it.
class ProjectedObjective final : public Objective, private ResidualFunction {
 public:
  /// Throws std::invalid_argument unless `function` has linear and other
  /// parameters.
  explicit ProjectedObjective(const RegressionFunction& function);

  Eigen::Index num_parameters() const override;
  double Evaluate(const Eigen::VectorXd& a,
                  Eigen::VectorXd* gradient) const override;
  const ResidualFunction* residuals() const override { return this; }

  /// Reduce returns the parameters a of b (p); Complete adds the best c to a.
  Eigen::VectorXd Reduce(const Eigen::VectorXd& b) const;
  Eigen::VectorXd Complete(const Eigen::VectorXd& a) const;

 private:
  Eigen::Index num_residuals() const override {
    return function_.num_observations();
  }
  double ridge() const override { return 0.0; }
  void Evaluate(const Eigen::VectorXd& a,
                Eigen::VectorXd* residuals,
                Eigen::MatrixXd* jacobian) const override;

  const RegressionFunction& function_;
  std::vector<Eigen::Index> linear_;
  std::vector<Eigen::Index> others_;
};

}  // namespace errmap::fitting
