#pragma once

#include <vector>

#include "stats/eigen.h"

namespace errmap::stats {

/// Differences in RMSE that the user regards as negligible.
struct Margin {
  double share = 0.05;        // of the best RMSE; at least 0
  double indifference = 0.0;  // in the target's unit; at least 0

  /// Returns the larger of the two, in the target's unit.
  double Of(double best_rmse) const;
  /// Throws std::invalid_argument unless both are finite and at least 0.
  void Validate() const;
};

/// Returns tiers of models that do not differ in practice: best tier first,
/// each in order of RMSE. A tier holds the model with the lowest RMSE and all
/// models whose `excess_at_most(model, best)` is within the margin. This is the
/// one-sided 95 % upper bound of (RMSE - best RMSE). The remaining models form
/// the next tier. A difference that is merely not significant does not suffice.
/// Without a bound (NaN), only a model of equal RMSE (to a relative 1e-12)
/// shares the tier.
///
/// `rmse` (models), `excess_at_most` (models x models). Throws
/// std::invalid_argument for other shapes or an RMSE that is not finite.
std::vector<std::vector<Index>> FormTiers(const VectorXd& rmse,
                                          const MatrixXd& excess_at_most,
                                          const Margin& margin);

}  // namespace errmap::stats
