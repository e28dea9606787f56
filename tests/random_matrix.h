#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "stats/random.h"

namespace errmap::testing {

/// Uniform in [-1, 1), the same for a seed everywhere.
inline Eigen::MatrixXd RandomMatrix(Eigen::Index rows,
                                    Eigen::Index cols,
                                    std::uint64_t seed) {
  stats::Random random(seed);
  Eigen::MatrixXd matrix(rows, cols);
  for (double& value : matrix.reshaped()) value = 2.0 * random.Uniform() - 1.0;
  return matrix;
}

inline Eigen::VectorXd RandomVector(Eigen::Index rows, std::uint64_t seed) {
  return RandomMatrix(rows, 1, seed);
}

}  // namespace errmap::testing
