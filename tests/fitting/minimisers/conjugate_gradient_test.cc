#include "fitting/minimisers/conjugate_gradient.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fitting/test_problems.h"

namespace errmap::fitting {
namespace {

using Eigen::VectorXd;
using errmap::testing::FunctionObjective;
using ::testing::HasSubstr;

// 1/2 x'Hx - b'x.
FunctionObjective Quadratic(const Eigen::MatrixXd& hessian, const VectorXd& b) {
  return {b.size(), [hessian, b](const VectorXd& x, VectorXd* gradient) {
            const VectorXd slope = hessian * x - b;
            if (gradient != nullptr) *gradient = slope;
            return 0.5 * x.dot(slope - b);
          }};
}

TEST(ConjugateGradient, SolvesAQuadraticInAsManyStepsAsItHasParameters) {
  // The difference quotient knows the curvature to about 1e-8.
  constexpr double kQuotient = 1e-7;
  const Eigen::Matrix3d hessian{
      {4.0, 1.0, 0.5}, {1.0, 3.0, -0.2}, {0.5, -0.2, 2.0}};
  const VectorXd b{{1.0, -2.0, 3.0}};
  ConjugateGradientOptions options;
  options.stopping.iterations = 3;
  const Minimum minimum = ConjugateGradient(options).Minimize(
      Quadratic(hessian, b), VectorXd::Zero(3));
  EXPECT_EQ(minimum.summary.iterations, 3);
  EXPECT_LT((hessian * minimum.x - b).norm(), kQuotient);
  // The start, then a quotient and a step each.
  EXPECT_EQ(minimum.summary.gradient_evaluations, 7);
  EXPECT_EQ(minimum.summary.value_evaluations, 0);
}

// Eq. (90), (91): x1 = x0 + mu/delta p with p = -g, mu = |g|^2, delta = p'Hp.
TEST(ConjugateGradient, FirstStepIsTheMinimumOfTheParabola) {
  constexpr double kQuotient = 1e-7;
  const Eigen::Matrix2d hessian{{10.0, 0.0}, {0.0, 1.0}};
  const VectorXd start{{1.0, 1.0}};
  ConjugateGradientOptions options;
  options.stopping.iterations = 1;
  const Minimum minimum = ConjugateGradient(options).Minimize(
      Quadratic(hessian, VectorXd::Zero(2)), start);
  const double step = (100.0 + 1.0) / (1000.0 + 1.0);
  EXPECT_NEAR(minimum.x[0], 1.0 - 10.0 * step, kQuotient);
  EXPECT_NEAR(minimum.x[1], 1.0 - 1.0 * step, kQuotient);
}

TEST(ConjugateGradient, GoesDownWhereTheCurvatureIsNegative) {
  // x0^4 / 4 - x0^2 / 2: a hill at 0 between minima at -1 and 1.
  const FunctionObjective hill(1, [](const VectorXd& x, VectorXd* gradient) {
    const double square = x[0] * x[0];
    if (gradient != nullptr) *gradient = VectorXd{{x[0] * (square - 1.0)}};
    return square * (0.25 * square - 0.5);
  });
  for (const double start : {1e-3, -0.3, 0.5}) {
    const Minimum minimum =
        ConjugateGradient({}).Minimize(hill, VectorXd{{start}});
    EXPECT_TRUE(minimum.summary.converged()) << minimum.summary.message;
    EXPECT_NEAR(minimum.x[0], std::copysign(1.0, start), 1e-6);
  }
}

// Where there is no lowest point each step goes further down.
TEST(ConjugateGradient, EndsByALimitWhereTheCostHasNoEnd) {
  const Eigen::Matrix2d hessian{{-1.0, 0.0}, {0.0, 2.0}};
  const Minimum minimum = ConjugateGradient({}).Minimize(
      Quadratic(hessian, VectorXd::Zero(2)), VectorXd{{1.0, 0.5}});
  EXPECT_FALSE(minimum.summary.converged());
  EXPECT_LT(minimum.summary.final_cost, -1e6);
  EXPECT_TRUE(minimum.x.allFinite());
}

TEST(ConjugateGradientOptions, RefuseASigmaOutOfRange) {
  EXPECT_NO_THROW(ConjugateGradientOptions().Validate());
  for (const double bad : {0.0, -1e-8, std::nan("")}) {
    ConjugateGradientOptions options;
    options.sigma = bad;
    try {
      ConjugateGradient{options};
      ADD_FAILURE() << bad << " was taken";
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(
          error.what(),
          HasSubstr("ConjugateGradientOptions: sigma must be above 0, found"));
    }
  }
}

}  // namespace
}  // namespace errmap::fitting
