#pragma once

#include <Eigen/Core>

namespace errmap {

// Eigen's sizes, vectors and matrices go by their own names everywhere.
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace errmap
