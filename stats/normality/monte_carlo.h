#pragma once

#include <Eigen/Core>

#include "stats/random.h"

namespace errmap::stats {

/// n independent standard normal values: quantiles of uniform ones, so the
/// same with every standard library.
Eigen::VectorXd NormalSample(Eigen::Index n, Random* random);

}  // namespace errmap::stats
