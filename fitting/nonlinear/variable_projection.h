#pragma once

#include <vector>

#include "fitting/nonlinear/nonlinear_regression.h"
#include "stats/eigen.h"

namespace errmap::fitting {

/// A regression with its conditionally linear parameters c eliminated. For
/// given other parameters a, c is the least squares solution, so that
///
///   f(a) = min over c of 1/2 |r(a, c)|^2
///
/// (Golub & Pereyra, SIAM J. Numer. Anal. 10, 1973). The Jacobian is Kaufman's
/// (BIT 15, 1975): that of r in a, projected onto the complement of the columns
/// of c. Its J'r is the exact gradient. The initial guess of c does not matter.
/// `function` must outlive it.
class ProjectedObjective final : public RegressionObjective {
 public:
  /// Throws std::invalid_argument unless `function` has linear and other
  /// parameters.
  explicit ProjectedObjective(const RegressionFunction& function);

  using RegressionObjective::Evaluate;
  Index num_parameters() const override { return std::ssize(others_); }

  /// Reduce returns the parameters a of b (p); Complete adds the best c to a.
  VectorXd Reduce(const VectorXd& b) const { return b(others_); }
  VectorXd Complete(const VectorXd& a) const;

 private:
  void Evaluate(const VectorXd& a,
                VectorXd* residuals,
                MatrixXd* jacobian) const override;

  std::vector<Index> linear_;
  std::vector<Index> others_;
};

}  // namespace errmap::fitting
