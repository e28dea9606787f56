#include "fitting/minimisers/ceres_optimizer.h"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fitting/optimizer_cases.h"
#include "tests/fitting/test_problems.h"
#include "tests/fitting/watched_objective.h"

namespace errmap::fitting {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::Rosenbrock;
using ::testing::HasSubstr;
using ::testing::Property;
using ::testing::Throws;

// y_i = exp(-x1 t_i) + x2 with a ridge, as residuals and as a cost. Where
// x1 < `edge` it is not finite; the Jacobian is `factor` times the true one.
class DecayObjective final : public Objective, public ResidualFunction {
 public:
  explicit DecayObjective(double ridge = 0.0,
                          double edge = -HUGE_VAL,
                          double factor = 1.0)
      : ridge_(ridge), edge_(edge), factor_(factor) {}

  Eigen::Index num_parameters() const override { return 2; }
  Eigen::Index num_residuals() const override { return kRows; }
  double ridge() const override { return ridge_; }
  const ResidualFunction* residuals() const override { return this; }

  void Evaluate(const VectorXd& x,
                VectorXd* residuals,
                MatrixXd* jacobian) const override {
    residuals->resize(kRows);
    if (jacobian != nullptr) jacobian->resize(kRows, 2);
    for (int i = 0; i < kRows; ++i) {
      const double t = 0.5 * i;
      const double value = std::exp(-x[0] * t);
      (*residuals)[i] =
          x[0] < edge_ ? std::nan("") : std::exp(-0.7 * t) + 0.3 - value - x[1];
      if (jacobian != nullptr) {
        (*jacobian)(i, 0) = factor_ * t * value;
        (*jacobian)(i, 1) = -factor_;
      }
    }
  }

  double Evaluate(const VectorXd& x, VectorXd* gradient) const override {
    VectorXd r;
    MatrixXd jacobian;
    Evaluate(x, &r, &jacobian);
    if (gradient != nullptr) {
      *gradient = jacobian.transpose() * r / factor_ + ridge_ * x;
    }
    return 0.5 * r.squaredNorm() + 0.5 * ridge_ * x.squaredNorm();
  }

 private:
  static constexpr int kRows = 12;
  double ridge_;
  double edge_;
  double factor_;
};

TEST(CeresOptions, DefaultsAreInRangeAndEachBoundBites) {
  EXPECT_NO_THROW(CeresOptions().Validate());
  EXPECT_THAT([] { CeresOptimizer({.memory = 0}); },
              Throws<std::invalid_argument>(
                  Property(&std::exception::what, HasSubstr("memory"))));
}

class GaussNewton : public ::testing::TestWithParam<CeresMethod> {};

TEST_P(GaussNewton, FindsTheMinimumOfResiduals) {
  const DecayObjective f;
  const Minimum minimum =
      CeresOptimizer({.method = GetParam()}).Minimize(f, VectorXd{{3.0, 0.0}});
  EXPECT_EQ(minimum.summary.termination, Termination::kGradient)
      << minimum.summary.message;
  EXPECT_NEAR(minimum.x[0], 0.7, 1e-9);
  EXPECT_NEAR(minimum.x[1], 0.3, 1e-9);
  EXPECT_LT(minimum.summary.iterations, 30);
}

TEST_P(GaussNewton, TakesTheRidgeAsFurtherResiduals) {
  constexpr double kRidge = 0.2;
  const DecayObjective f(kRidge);
  const Minimum by_residuals =
      CeresOptimizer(
          {.stopping = {.gradient_goal = 1e-9}, .method = GetParam()})
          .Minimize(f, VectorXd{{3.0, 0.0}});
  const Minimum by_gradients =
      CeresOptimizer(
          {.stopping = {.gradient_goal = 1e-9}, .method = CeresMethod::kBfgs})
          .Minimize(f, VectorXd{{3.0, 0.0}});
  ASSERT_TRUE(by_residuals.summary.converged()) << by_residuals.summary.message;
  ASSERT_TRUE(by_gradients.summary.converged()) << by_gradients.summary.message;
  EXPECT_LT((by_residuals.x - by_gradients.x).norm(), 1e-7);
  EXPECT_GT((by_residuals.x - VectorXd{{0.7, 0.3}}).norm(), 1e-3);
}

TEST_P(GaussNewton, KeepsItsLimitsAndItsBestPoint) {
  const DecayObjective f(0.1);
  for (std::int64_t limit = 1; limit <= 6; ++limit) {
    const Minimum minimum = CeresOptimizer({.stopping = {.evaluations = limit},
                                            .method = GetParam()})
                                .Minimize(f, VectorXd{{3.0, 0.0}});
    if (!minimum.summary.converged()) {
      EXPECT_EQ(minimum.summary.evaluations(), limit);
      EXPECT_EQ(minimum.summary.termination, Termination::kEvaluationLimit)
          << minimum.summary.message;
    }
    EXPECT_EQ(minimum.summary.final_cost, f.Evaluate(minimum.x, nullptr));
    EXPECT_LE(minimum.summary.final_cost, minimum.summary.initial_cost);
  }
  const Minimum stopped =
      CeresOptimizer({.stopping = {.iterations = 2}, .method = GetParam()})
          .Minimize(f, VectorXd{{3.0, 0.0}}, {.keep_trace = true});
  EXPECT_EQ(stopped.summary.termination, Termination::kIterationLimit);
  EXPECT_EQ(stopped.summary.iterations, 2);
  EXPECT_EQ(stopped.summary.trace.size(), 3U);
}

// Ceres finds fault with nothing here: the radius shrinks until nothing moves.
TEST_P(GaussNewton, ClaimsNoMinimumWithAJacobianThatPointsUphill) {
  const DecayObjective f(0.0, -HUGE_VAL, -1.0);
  const Minimum minimum =
      CeresOptimizer({.method = GetParam()}).Minimize(f, VectorXd{{3.0, 0.0}});
  EXPECT_FALSE(minimum.summary.converged()) << minimum.summary.message;
  EXPECT_EQ(minimum.summary.termination, Termination::kNoDescent);
  EXPECT_THAT(minimum.summary.message, HasSubstr("Ceres:"));
}

TEST_P(GaussNewton, StaysWhereItIsFinite) {
  const DecayObjective f(0.0, 0.9);  // the minimum lies outside
  const Minimum minimum =
      CeresOptimizer({.method = GetParam()}).Minimize(f, VectorXd{{3.0, 0.0}});
  EXPECT_FALSE(minimum.summary.converged()) << minimum.summary.message;
  EXPECT_GE(minimum.x[0], 0.9);
  EXPECT_TRUE(std::isfinite(minimum.summary.final_cost));
}

TEST_P(GaussNewton, NeedsResiduals) {
  const auto problem = Rosenbrock();
  EXPECT_THAT(
      [&] {
        CeresOptimizer({.method = GetParam()})
            .Minimize(*problem.objective, problem.start);
      },
      Throws<std::invalid_argument>(Property(
          &std::exception::what, HasSubstr("sum of squared residuals"))));
}

INSTANTIATE_TEST_SUITE_P(
    All,
    GaussNewton,
    ::testing::Values(CeresMethod::kLevenbergMarquardt, CeresMethod::kDogleg),
    [](const ::testing::TestParamInfo<CeresMethod>& method) {
      return method.param == CeresMethod::kDogleg ? "Dogleg"
                                                  : "LevenbergMarquardt";
    });

TEST(CeresOptimizer, ChoosesGaussNewtonWhereThereAreResidualsAndStepsAreCheap) {
  const CeresOptimizer automatic(CeresOptions{});
  EXPECT_EQ(automatic.name(), "ceres:auto");
  EXPECT_EQ(automatic.MethodFor(DecayObjective()),
            CeresMethod::kLevenbergMarquardt);
  EXPECT_EQ(automatic.MethodFor(*Rosenbrock().objective), CeresMethod::kLbfgs);
}

TEST(CeresOptimizer, PrintsNothing) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  const DecayObjective f(0.0, 0.9);
  CeresOptimizer({}).Minimize(f, VectorXd{{3.0, 0.0}});
  const auto problem = errmap::testing::NotANumberOutside();
  CeresOptimizer({}).Minimize(*problem.objective, problem.start);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace errmap::fitting
