#include "fitting/minimisers/gradient_check.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fitting/test_problems.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using errmap::testing::AllTestProblems;
using errmap::testing::FunctionObjective;
using errmap::testing::NotANumberOutside;
using errmap::testing::Rosenbrock;
using errmap::testing::TestProblem;

// Ridders' extrapolation leaves about the rounding of f over the step.
constexpr double kExtrapolated = 1e-10;

// f with one component of its gradient spoilt.
FunctionObjective Spoilt(const TestProblem& problem,
                         Index parameter,
                         double factor) {
  return FunctionObjective(
      problem.start.size(),
      [problem, parameter, factor](const VectorXd& x, VectorXd* gradient) {
        const double value = problem.objective->Evaluate(x, gradient);
        if (gradient != nullptr) (*gradient)[parameter] *= factor;
        return value;
      });
}

TEST(RiddersDerivative, FindsDerivativesOfSmoothFunctions) {
  const auto exponential = [](double t) { return std::exp(t); };
  EXPECT_NEAR(RiddersDerivative(exponential, 1.0, 0.5).value,
              std::numbers::e,
              kExtrapolated);
  const auto sine = [](double t) { return std::sin(t); };
  EXPECT_NEAR(
      RiddersDerivative(sine, 0.3, 0.5).value, std::cos(0.3), kExtrapolated);
  const auto inverse = [](double t) { return 1.0 / t; };
  EXPECT_NEAR(RiddersDerivative(inverse, 2.0, 0.5).value, -0.25, kExtrapolated);
}

TEST(RiddersDerivative, IsExactForParabolasToRounding) {
  constexpr double kRounding = 1e-14;
  const auto parabola = [](double t) { return 3.0 * t * t - 2.0 * t + 5.0; };
  EXPECT_NEAR(RiddersDerivative(parabola, 0.5, 0.25).value, 1.0, kRounding);
}

TEST(RiddersDerivative, OfAConstantIsExactlyZero) {
  const Derivative derivative =
      RiddersDerivative([](double) { return 7.0; }, 1.0, 0.1);
  EXPECT_EQ(derivative.value, 0.0);
  EXPECT_EQ(derivative.error, 0.0);
}

TEST(RiddersDerivative, EstimatesItsOwnErrorHonestly) {
  // The estimate is a heuristic: it may be low, but not by orders.
  constexpr double kMargin = 10.0;
  for (double t = -2.0; t <= 2.0; t += 0.25) {
    const Derivative derivative =
        RiddersDerivative([](double s) { return std::tanh(s); }, t, 0.5);
    const double cosh = std::cosh(t);
    const double error = std::abs(derivative.value - 1.0 / (cosh * cosh));
    EXPECT_LE(error, kMargin * derivative.error + 1e-14) << t;
    EXPECT_LT(derivative.error, 1e-8) << t;
  }
}

TEST(RiddersDerivative, IsNotANumberWhereTheFunctionIsNone) {
  const Derivative derivative =
      RiddersDerivative([](double) { return std::nan(""); }, 0.0, 0.1);
  EXPECT_TRUE(std::isnan(derivative.value));
}

TEST(CheckGradient, PassesEveryTestProblem) {
  for (const TestProblem& problem : AllTestProblems()) {
    // A point between start and minimum, off both: nothing vanishes by luck.
    const VectorXd off = VectorXd::LinSpaced(problem.start.size(), 0.11, 0.37);
    for (const VectorXd& x :
         {VectorXd(problem.start),
          VectorXd(0.5 * (problem.start + problem.minimum) + off)}) {
      const GradientCheck check = CheckGradient(*problem.objective, x);
      EXPECT_LT(check.worst_relative_error, 1e-8)
          << problem.name << ", parameter " << check.worst_parameter
          << ": analytic " << check.worst_analytic << ", numeric "
          << check.worst_numeric;
    }
  }
}

TEST(CheckGradient, KnownMinimaOfTheTestProblemsAreStationary) {
  // Rounding of coefficients up to 1e6 times coordinates of size 2.
  constexpr double kRounding = 1e-9;
  for (const TestProblem& problem : AllTestProblems()) {
    VectorXd gradient;
    const double value =
        problem.objective->Evaluate(problem.minimum, &gradient);
    EXPECT_NEAR(value, problem.minimum_value, kRounding) << problem.name;
    EXPECT_LT(gradient.norm(), kRounding) << problem.name;
    EXPECT_EQ(problem.objective->num_parameters(), problem.start.size());
    EXPECT_LE(value, problem.objective->Evaluate(problem.start, nullptr));
  }
}

TEST(CheckGradient, NamesTheParameterThatIsWrong) {
  constexpr double kTenPercent = 1.1;
  for (const Index parameter : {0, 1, 2, 3}) {
    const TestProblem wood = errmap::testing::Wood();
    const GradientCheck check =
        CheckGradient(Spoilt(wood, parameter, kTenPercent), wood.start);
    EXPECT_EQ(check.worst_parameter, parameter);
    EXPECT_NEAR(check.worst_relative_error, kTenPercent - 1.0, 1e-7);
    EXPECT_NEAR(check.worst_analytic / check.worst_numeric, kTenPercent, 1e-7);
  }
}

TEST(CheckGradient, SeesASmallSlipAndAWrongSign) {
  constexpr double kSlip = 1e-6;
  const TestProblem problem = Rosenbrock();
  EXPECT_NEAR(CheckGradient(Spoilt(problem, 1, 1.0 + kSlip), problem.start)
                  .worst_relative_error,
              kSlip,
              0.01 * kSlip);
  EXPECT_NEAR(CheckGradient(Spoilt(problem, 0, -1.0), problem.start)
                  .worst_relative_error,
              2.0,
              1e-7);
}

TEST(CheckGradient, DoesNotJudgeAZeroComponentByItsOwnSize) {
  // df/dx2 = 0 at x2 = 0 among a slope of 1e3: rounding there is no fault.
  const FunctionObjective f(2, [](const VectorXd& x, VectorXd* gradient) {
    if (gradient != nullptr) *gradient << 1e3 * std::cos(x[0]), 2.0 * x[1];
    return 1e3 * std::sin(x[0]) + x[1] * x[1];
  });
  EXPECT_LT(CheckGradient(f, VectorXd::Zero(2)).worst_relative_error, 1e-8);
}

TEST(CheckGradient, CountsNotANumberAsTheWorst) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const TestProblem problem = Rosenbrock();
  const GradientCheck analytic =
      CheckGradient(Spoilt(problem, 1, kNaN), problem.start);
  EXPECT_TRUE(std::isnan(analytic.worst_relative_error));
  EXPECT_EQ(analytic.worst_parameter, 1);
  const TestProblem outside = NotANumberOutside();
  EXPECT_TRUE(
      std::isnan(CheckGradient(*outside.objective, VectorXd{{-5.0, 0.0}})
                     .worst_relative_error));
}

}  // namespace
}  // namespace errmap::fitting
