#include "data/measurements/least_squares.h"

#include <Eigen/QR>

namespace errmap::data {

Eigen::VectorXd SolveLeastSquares(const Eigen::MatrixXd& design,
                                  const Eigen::VectorXd& wanted) {
  return design.colPivHouseholderQr().solve(wanted);
}

}  // namespace errmap::data
