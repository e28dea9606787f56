#pragma once

#include <Eigen/Core>

namespace errmap::models {

/// Weights w >= 0 of sum 1 (k) that minimise |targets - predictions w|^2 over
/// the rows where every prediction is a number (Breiman 1996, stacked
/// regressions). `predictions` (n x k) are of rows held out. Equal weights
/// where no row has all of them.
Eigen::VectorXd StackingWeights(const Eigen::MatrixXd& predictions,
                                const Eigen::VectorXd& targets);

}  // namespace errmap::models
