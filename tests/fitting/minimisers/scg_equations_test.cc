// Moller's steps by the equations of NISTIR 5367, one by one.

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "fitting/minimisers/scaled_conjugate_gradient.h"
#include "tests/fitting/test_problems.h"

namespace errmap::fitting {
namespace {

// Eq. (109) of NISTIR 5367: p1 = r1 + beta p0, beta = (|r1|^2 - r1'r0) / mu0.
TEST(ScgEquations, MollerTurnsByTheBetaOfEquation109) {
  constexpr double kRounding = 1e-12;
  const auto problem = errmap::testing::Wood();
  std::vector<ScgPass> passes;
  const auto point_after = [&](std::int64_t iterations) {
    passes.clear();
    ScaledConjugateGradientOptions options;
    options.stopping.iterations = iterations;
    options.observer = [&](const ScgPass& pass) { passes.push_back(pass); };
    return ScaledConjugateGradient(options)
        .Minimize(*problem.objective, problem.start)
        .x;
  };
  const Eigen::VectorXd x1 = point_after(1);
  const Eigen::VectorXd x2 = point_after(2);
  for (const ScgPass& pass : passes) {
    ASSERT_FALSE(pass.restarted || pass.gave_up_direction);
  }
  Eigen::VectorXd r0;
  Eigen::VectorXd r1;
  problem.objective->Evaluate(problem.start, &r0);
  problem.objective->Evaluate(x1, &r1);
  r0 = -r0;
  r1 = -r1;
  const double beta = (r1.squaredNorm() - r1.dot(r0)) / r0.squaredNorm();
  const Eigen::VectorXd p1 = r1 + beta * r0;
  const Eigen::VectorXd step = x2 - x1;
  EXPECT_NEAR(step.dot(p1),
              step.norm() * p1.norm(),
              kRounding * step.norm() * p1.norm());
  EXPECT_NEAR((x1 - problem.start).dot(r0),
              (x1 - problem.start).norm() * r0.norm(),
              kRounding * (x1 - problem.start).norm() * r0.norm());
}

// Eq. (110) and (111): lambda halves after a good success (comparison >= 0.75),
// stays after a fair one, grows by delta (1 - comparison) / |p|^2 below 0.25.
TEST(ScgEquations, MollerScalesLambdaByTheComparisonOfEquation110) {
  const auto problem = errmap::testing::Wood();
  std::vector<ScgPass> passes;
  ScaledConjugateGradientOptions options;
  options.stopping.iterations = 60;
  options.observer = [&](const ScgPass& pass) { passes.push_back(pass); };
  ScaledConjugateGradient(options).Minimize(*problem.objective, problem.start);
  int good = 0;
  int poor = 0;
  double before = options.initial_lambda;
  for (const ScgPass& pass : passes) {
    if (!pass.made_definite && !pass.restarted && !pass.gave_up_direction) {
      if (pass.accepted && pass.comparison >= 0.75) {
        EXPECT_EQ(pass.lambda, 0.5 * before);
        ++good;
      } else if (pass.accepted && pass.comparison >= 0.25) {
        EXPECT_EQ(pass.lambda, before);
      } else {
        EXPECT_GT(pass.lambda, before);
        ++poor;
      }
    }
    before = pass.lambda;
  }
  EXPECT_GT(good, 5);
  EXPECT_GT(poor, 0);
}

// 1 + cos x, whose Hessian is negative where the run begins.
class Cosine final : public Objective {
 public:
  Eigen::Index num_parameters() const override { return 1; }
  double Evaluate(const Eigen::VectorXd& x,
                  Eigen::VectorXd* gradient) const override {
    if (gradient != nullptr) {
      *gradient = Eigen::VectorXd::Constant(1, -std::sin(x[0]));
    }
    return 1.0 + std::cos(x[0]);
  }
};

// Eq. (105) turns delta = p'Hp + lambda p'p into -p'Hp, whatever lambda was.
TEST(ScgEquations, MollerTurnsNegativeCurvatureRound) {
  std::vector<ScgPass> passes;
  ScaledConjugateGradientOptions options;
  options.stopping.iterations = 1;
  options.observer = [&](const ScgPass& pass) { passes.push_back(pass); };
  ScaledConjugateGradient(options).Minimize(Cosine(), Eigen::VectorXd::Ones(1));
  ASSERT_FALSE(passes.empty());
  EXPECT_TRUE(passes[0].made_definite);
  constexpr double kOfDifferences = 1e-4;  // p'Hp by default
  EXPECT_NEAR(passes[0].alpha, 1.0 / std::cos(1.0), kOfDifferences);
}

}  // namespace
}  // namespace errmap::fitting
