#pragma once

#include <vector>

#include <Eigen/Core>

namespace errmap::stats {

/// What does not matter to the user.
struct Margin {
  double share = 0.05;        // of the best RMSE; at least 0
  double indifference = 0.0;  // in the target's unit; at least 0

  /// The larger of the two.
  double Of(double best_rmse) const;
  /// Throws std::invalid_argument unless both are finite and at least 0.
  void Validate() const;
};

/// Models that do not differ in practice, best tier first, each tier in order
/// of RMSE: the model with the lowest RMSE and all for which
/// `excess_at_most(model, best)`, the one-sided 95 % upper bound of (RMSE -
/// best RMSE), is within the margin; then the same among the rest. Lack of
/// significance admits nobody: where no bound exists (NaN), only a model with
/// the best's RMSE itself (to a relative 1e-12) shares its tier.
///
/// `rmse` (models), `excess_at_most` (models x models); throws
/// std::invalid_argument for other shapes or an RMSE that is not finite.
std::vector<std::vector<Eigen::Index>> FormTiers(
    const Eigen::VectorXd& rmse,
    const Eigen::MatrixXd& excess_at_most,
    const Margin& margin);

}  // namespace errmap::stats
