#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "fitting/least_squares/decompositions.h"
#include "fitting/minimisers/optimizer.h"

namespace errmap::testing {

/// What Newton's step promises at x, by a dense Hessian of central differences
/// and its eigenvalues; infinite where one is not positive.
inline double NewtonDecrease(const fitting::Objective& f,
                             const Eigen::VectorXd& x) {
  constexpr double kStep = 1e-5;
  const Eigen::Index n = x.size();
  const double h = kStep * std::max(1.0, x.norm());
  Eigen::VectorXd gradient;
  Eigen::VectorXd above;
  Eigen::VectorXd below;
  Eigen::MatrixXd hessian(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(n, i);
    f.Evaluate(x + step, &above);
    f.Evaluate(x - step, &below);
    hessian.col(i) = (above - below) / (2.0 * h);
  }
  f.Evaluate(x, &gradient);
  const Eigen::MatrixXd symmetric = 0.5 * (hessian + hessian.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric);
  if (!(solver.eigenvalues()[0] > 0.0)) {
    return std::numeric_limits<double>::infinity();
  }
  const Eigen::VectorXd along = solver.eigenvectors().transpose() * gradient;
  return 0.5 * along.cwiseAbs2().cwiseQuotient(solver.eigenvalues()).sum();
}

/// Where `minimum` claims to be one, its gradient is as small as was asked, or
/// the cost is that of a minimum to nine digits (or to the rounding of 1, for
/// costs that are differences of numbers about 1).
inline void ExpectTrueClaim(const fitting::Objective& f,
                            const fitting::Minimum& minimum,
                            double gradient_goal) {
  const fitting::FitSummary& summary = minimum.summary;
  if (!summary.converged()) return;
  Eigen::VectorXd gradient;
  const double cost = f.Evaluate(minimum.x, &gradient);
  if (summary.termination == fitting::Termination::kResolution) {
    EXPECT_LE(NewtonDecrease(f, minimum.x),
              std::max(1.01e-9 * std::abs(cost),
                       4.0 * std::numeric_limits<double>::epsilon()))
        << "claims a minimum at the resolution of a cost of " << cost;
    return;
  }
  EXPECT_TRUE(gradient.norm() == 0.0 ||
              gradient.norm() < gradient_goal * std::max(1.0, minimum.x.norm()))
      << "claims a minimum with a gradient of " << gradient.norm();
}

}  // namespace errmap::testing
