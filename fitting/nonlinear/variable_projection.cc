#include "fitting/nonlinear/variable_projection.h"

#include <algorithm>
#include <stdexcept>

#include "fitting/least_squares/linear_least_squares.h"
#include "stats/not_a_number.h"

namespace errmap::fitting {

ProjectedObjective::ProjectedObjective(const RegressionFunction& function)
    : RegressionObjective(function), linear_(function.linear_parameters()) {
  for (Index j = 0; j < function.num_parameters(); ++j) {
    if (std::find(linear_.begin(), linear_.end(), j) == linear_.end()) {
      others_.push_back(j);
    }
  }
  if (linear_.empty() || others_.empty()) {
    throw std::invalid_argument(
        "ProjectedObjective: needs linear parameters and others, found " +
        std::to_string(linear_.size()) + " and " +
        std::to_string(others_.size()));
  }
}

VectorXd ProjectedObjective::Complete(const VectorXd& a) const {
  VectorXd b = VectorXd::Zero(function().num_parameters());
  b(others_) = a;
  VectorXd residuals;
  MatrixXd jacobian;
  function().Evaluate(b, &residuals, &jacobian);
  const MatrixXd columns = jacobian(Eigen::all, linear_);
  if (!columns.allFinite() || !residuals.allFinite()) {
    b.setConstant(stats::kNaN);
    return b;
  }
  // With c = 0 in b: r(a, c) = r(a, 0) + (dr/dc) c.
  b(linear_) = SolveLeastSquares(columns, -residuals).coefficients;
  return b;
}

void ProjectedObjective::Evaluate(const VectorXd& a,
                                  VectorXd* residuals,
                                  MatrixXd* jacobian) const {
  MatrixXd full;
  function().Evaluate(Complete(a), residuals, &full);
  if (jacobian == nullptr) return;
  *jacobian = full(Eigen::all, others_);
  const MatrixXd columns = full(Eigen::all, linear_);
  if (!jacobian->allFinite() || !columns.allFinite()) return;
  const MatrixXd basis = OrthonormalColumns(columns);
  *jacobian -= basis * (basis.transpose() * *jacobian);
}

}  // namespace errmap::fitting
