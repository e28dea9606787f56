#pragma once

#include <Eigen/Core>

#include "stats/random.h"

namespace errmap::stats {

/// Returns n independent standard normal values, the same with every standard
/// library: the normal quantiles of uniform values.
Eigen::VectorXd NormalSample(Eigen::Index n, Random* random);

}  // namespace errmap::stats
