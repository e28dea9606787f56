#pragma once

#include <Eigen/Core>

namespace errmap::stats {

/// Degrees of freedom of the mean of these `mean_squares` (n of them, n >= 2:
/// one of each unit). A mean square of f degrees of freedom has the variance
/// 2 mean^2 / f (Satterthwaite 1946; JCGM 100:2008, G.4). What they show of
/// that variance is uncertain itself: f is what they leave with a confidence of
/// 80 %, and `least` for each unit at least. Infinite where all are the same.
double UnitFreedom(const Eigen::VectorXd& mean_squares, double least = 1.0);

}  // namespace errmap::stats
